// Formats of movies: which files are whole, for files made byte by byte, and the arguments for ffmpeg.
#include "io/movie/movie_format.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using namespace std::string_literals;

class MovieFiles : public ::testing::Test {
 protected:
  bool whole(const std::string& bytes, MovieFormat format) const {
    return is_whole_movie(folder_.write("movie", bytes), format);
  }
  test::TestFolder folder_{"movie_format"};
};

const std::string ftyp = "\0\0\0\x10"s + "ftypisomabcd", moov = "\0\0\0\x0b"s + "moovxyz",
                  mdat = "\0\0\0\x0c"s + "mdatdata";
// A block whose size is stored in 64 bits.
const std::string large_mdat = "\0\0\0\x01mdat\0\0\0\0\0\0\0\x13"s + "abc";

TEST_F(MovieFiles, AnMp4IsWholeWithAllOfItsBoxesAndItsIndex) {
  const auto is_whole = [&](const std::string& bytes) { return whole(bytes, MovieFormat::mp4); };
  EXPECT_TRUE(is_whole(ftyp + moov + mdat));
  EXPECT_TRUE(is_whole(ftyp + mdat + moov));
  EXPECT_TRUE(is_whole(ftyp + large_mdat + moov));
  EXPECT_FALSE(is_whole(ftyp + mdat)) << "a file without an index";
  EXPECT_FALSE(is_whole(""));
  EXPECT_FALSE(is_whole_movie(folder_.path() / "none", MovieFormat::mp4));
  const std::string all = ftyp + moov + large_mdat;
  for (std::size_t bytes = 0; bytes < all.size(); ++bytes) {
    const bool ends_with_a_box = bytes == (ftyp + moov).size();
    EXPECT_EQ(is_whole(all.substr(0, bytes)), ends_with_a_box) << bytes;
  }
  EXPECT_FALSE(is_whole(ftyp + moov + mdat + "x"));
  EXPECT_FALSE(is_whole(ftyp + moov + "\0\0\0\0mdatdata"s)) << "a size that should have been written last";
  EXPECT_FALSE(is_whole(ftyp + moov + "\0\0\0\x07mdatdata"s));
  EXPECT_FALSE(is_whole(ftyp + moov + "\0\0\0\x01mdat\0\0\0\0\0\0\0\0abc"s));
}

TEST_F(MovieFiles, AWebmIsWholeWhereItsSegmentEnds) {
  const auto is_whole = [&](const std::string& bytes) { return whole(bytes, MovieFormat::webm); };
  const std::string head = "\x1a\x45\xdf\xa3\x84wxyz", segment = "\x18\x53\x80\x67";
  EXPECT_TRUE(is_whole(head + segment + "\x85" + "abcde"));
  EXPECT_TRUE(is_whole(head + segment + "\x40\x05" + "abcde"));
  EXPECT_TRUE(is_whole(head + segment + "\x01\0\0\0\0\0\0\x05"s + "abcde"));
  EXPECT_TRUE(is_whole(head + segment + "\x41\x04"s + std::string(260, 'x')));
  EXPECT_FALSE(is_whole(head + segment + "\x85" + "abcd"));
  EXPECT_FALSE(is_whole(head + segment + "\x85" + "abcdef"));
  EXPECT_FALSE(is_whole(head + segment + "\x01\xff\xff\xff\xff\xff\xff\xff"s + "abcde")) << "a segment of unknown size";
  EXPECT_FALSE(is_whole(head + segment + "\0"s));
  EXPECT_FALSE(is_whole(head + head));
  EXPECT_FALSE(is_whole(head));
  EXPECT_FALSE(is_whole(""));
}

TEST_F(MovieFiles, AGifIsWholeWithItsTrailer) {
  const auto is_whole = [&](const std::string& bytes) { return whole(bytes, MovieFormat::gif); };
  EXPECT_TRUE(is_whole("GIF89a frames\0;"s));
  EXPECT_FALSE(is_whole("GIF89a frames\0"s));
  EXPECT_FALSE(is_whole("GIF89a frames;"s));
  EXPECT_FALSE(is_whole("GIF98a frames\0;"s));
  EXPECT_FALSE(is_whole("GIF"));
}

TEST(MovieFormats, AreKnownByTheirExtensions) {
  EXPECT_EQ(movie_format_of(".mp4"), MovieFormat::mp4);
  EXPECT_EQ(movie_format_of(".WebM"), MovieFormat::webm);
  EXPECT_EQ(movie_format_of(".gif"), MovieFormat::gif);
  EXPECT_EQ(movie_format_of(".avi"), std::nullopt);
  EXPECT_EQ(movie_format_of("mp4"), std::nullopt);
  EXPECT_EQ(movie_name(MovieFormat::webm), "movie.webm");
}

TEST(MovieFormats, FfmpegIsToldTheSizeAndThePace) {
  const std::vector<std::string> words = encoding("/usr/bin/ffmpeg", {640, 480, 12.5}, MovieFormat::mp4, "part.mp4");
  const auto after = [&](const std::string& option) {
    const auto at = std::find(words.begin(), words.end(), option);
    return at == words.end() || at + 1 == words.end() ? "" : *(at + 1);
  };
  EXPECT_EQ(words.front(), "/usr/bin/ffmpeg");
  EXPECT_EQ(words.back(), "part.mp4");
  EXPECT_EQ(after("-video_size"), "640x480");
  EXPECT_EQ(after("-framerate"), "12.5");
  EXPECT_EQ(after("-bf"), "0") << "without B-frames, parts can be joined frame by frame";
  EXPECT_EQ(after("-movflags"), "+faststart");
}

}  // namespace
}  // namespace carom

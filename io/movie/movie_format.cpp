#include "io/movie/movie_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>

namespace carom {

namespace {

struct FormatRow {
  std::string_view extension;
  std::vector<std::string> options;
};

std::vector<std::string> joined(std::initializer_list<std::vector<std::string>> parts) {
  std::vector<std::string> all;
  for (const std::vector<std::string>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

const FormatRow& row_of(MovieFormat format) {
  // H.264 with the pixel format that every player supports. crf 20 is visually lossless for flat disks; without
  // B-frames (bf 0) parts can be joined with each frame at its time; faststart lets a browser begin before the end has
  // arrived. VP9 is used in the same way. A GIF has a palette for each frame, so no frames need to be kept in memory.
  // The colour space that every player supports: the filter converts to it, the marks name it in the file.
  static const std::vector<std::string> filter{"-vf", "scale=out_color_matrix=bt709:out_range=tv"};
  static const std::vector<std::string> marks{"-colorspace", "bt709",      "-color_primaries",
                                              "bt709",       "-color_trc", "bt709"};
  static const std::array<FormatRow, 3> rows{{
      {".mp4", joined({filter,
                       {"-c:v", "libx264", "-preset", "veryfast", "-crf", "20", "-bf", "0", "-pix_fmt", "yuv420p"},
                       marks,
                       {"-movflags", "+faststart"}})},
      {".webm", joined({filter,
                        {"-c:v", "libvpx-vp9", "-deadline", "good", "-cpu-used", "5", "-row-mt", "1", "-crf", "24",
                         "-b:v", "0", "-pix_fmt", "yuv420p"},
                        marks})},
      {".gif",
       {"-filter_complex",
        "split[a][b];[a]palettegen=stats_mode=single:reserve_transparent=0[p];[b][p]paletteuse=new=1:dither=none"}},
  }};
  return rows[static_cast<std::size_t>(format)];
}

// Is a file a sequence of complete MP4 boxes (32-bit size, name, content), with the index "moov" among them?
bool is_whole_mp4(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  bool indexed = false;
  std::uintmax_t at = 0;
  while (!error && at < bytes) {
    std::array<unsigned char, 8> head{};
    file.seekg(static_cast<std::streamoff>(at));
    if (!file.read(reinterpret_cast<char*>(head.data()), head.size())) return false;
    std::uintmax_t size = (std::uintmax_t{head[0]} << 24) | (std::uintmax_t{head[1]} << 16) |
                          (std::uintmax_t{head[2]} << 8) | std::uintmax_t{head[3]};
    if (size == 1) {  // a box above 4 GB: its size follows in 64 bits
      std::array<unsigned char, 8> large{};
      if (!file.read(reinterpret_cast<char*>(large.data()), large.size())) return false;
      size = 0;
      for (const unsigned char byte : large) size = (size << 8) | byte;
    }
    if (size < head.size()) return false;
    if (std::memcmp(&head[4], "moov", 4) == 0) indexed = true;
    at += size;
  }
  return !error && indexed && at == bytes;
}

// Is a file an EBML header and one segment that ends at the end of the file, as its size says? ffmpeg writes that size
// last.
bool is_whole_webm(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  // A number has one byte more than its first byte has leading zeros; the bit after the zeros does not count.
  const auto size_at = [&](std::uintmax_t& at) -> std::uintmax_t {
    file.seekg(static_cast<std::streamoff>(at));
    const int first = file.get();
    if (first <= 0) return 0;
    const int more = std::countl_zero(static_cast<std::uint8_t>(first));
    std::uintmax_t size = static_cast<std::uintmax_t>(first) & (0xffU >> (more + 1));
    for (int k = 0; k < more; ++k) size = (size << 8) | static_cast<std::uintmax_t>(file.get() & 0xff);
    at += static_cast<std::uintmax_t>(more) + 1;
    return size;
  };
  constexpr std::array<unsigned char, 4> header{0x1a, 0x45, 0xdf, 0xa3}, segment{0x18, 0x53, 0x80, 0x67};
  std::uintmax_t at = 0;
  for (const auto& id : {header, segment}) {
    std::array<char, 4> found{};
    file.seekg(static_cast<std::streamoff>(at));
    if (error || !file.read(found.data(), found.size()) || std::memcmp(found.data(), id.data(), id.size()) != 0) {
      return false;
    }
    at += id.size();
    const std::uintmax_t size = size_at(at);
    at += size;
  }
  return file.good() && at == bytes;
}

// Is a file complete from the signature to the end of its last frame and the trailer?
bool is_whole_gif(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 6> head{};
  if (!file.read(head.data(), head.size()) || std::string_view(head.data(), head.size()) != "GIF89a") return false;
  file.seekg(-2, std::ios::end);
  return file.get() == 0 && file.get() == 0x3b;
}

}  // namespace

std::string movie_name(MovieFormat format) {
  return fmt::format("movie{}", row_of(format).extension);
}

std::optional<MovieFormat> movie_format_of(std::string_view extension) {
  std::string small(extension);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const MovieFormat format : {MovieFormat::mp4, MovieFormat::webm, MovieFormat::gif}) {
    if (small == row_of(format).extension) return format;
  }
  return {};
}

std::vector<std::string> encoding(const std::string& program, const RawFrames& frames, MovieFormat format,
                                  const std::string& file) {
  const char* const pixels = std::endian::native == std::endian::little ? "bgr0" : "0rgb";
  std::vector<std::string> words{program,
                                 "-nostdin",
                                 "-loglevel",
                                 "error",
                                 "-y",
                                 "-f",
                                 "rawvideo",
                                 "-pix_fmt",
                                 pixels,
                                 "-video_size",
                                 fmt::format("{}x{}", frames.width, frames.height),
                                 "-framerate",
                                 fmt::format("{}", frames.fps),
                                 "-i",
                                 "pipe:0",
                                 "-an"};
  const std::vector<std::string>& options = row_of(format).options;
  words.insert(words.end(), options.begin(), options.end());
  words.push_back(file);
  return words;
}

bool is_whole_movie(const std::string& path, MovieFormat format) {
  switch (format) {
    case MovieFormat::webm:
      return is_whole_webm(path);
    case MovieFormat::gif:
      return is_whole_gif(path);
    case MovieFormat::mp4:
      break;
  }
  return is_whole_mp4(path);
}

}  // namespace carom

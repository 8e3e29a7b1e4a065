// The kinds of movie that ffmpeg makes of our frames.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

enum class MovieFormat : std::uint8_t { mp4, webm, gif };

// "movie.mp4" and so on.
std::string movie_name(MovieFormat format);

// The format for a file's extension with its dot, in small or capital letters.
std::optional<MovieFormat> movie_format_of(std::string_view extension);

// The command that makes `file` from raw frames on its standard input, with pixels as in FramePainter.
struct RawFrames {
  int width = 0, height = 0;  // pixels
  double fps = 25.0;
};
std::vector<std::string> encoding(const std::string& program, const RawFrames& frames, MovieFormat format,
                                  const std::string& file);

// Is the file complete? ffmpeg returns 0 even if a full disk cut its file short.
bool is_whole_movie(const std::string& path, MovieFormat format);

}  // namespace carom

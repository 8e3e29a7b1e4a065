// Positions and velocities from the text of CSV files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"

namespace carom {

// What the rows are meant to be.
enum class CsvPairs : std::uint8_t { any, places };

// The rows "x,y" of a CSV text. Blank lines and lines that start with '#' are skipped; the first other line may be a
// header of two names, but not "y,x", and not one of velocities ("vx,vy") if rows are positions. name, key: the file
// and the key, for messages. Throws InputError with "name:line: key: ..." for any line that is not two finite numbers.
std::vector<Vec2> parse_csv_pairs(std::string_view text, const std::string& name, std::string_view key,
                                  CsvPairs pairs = CsvPairs::any);

}  // namespace carom

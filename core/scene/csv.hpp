// Positions and velocities from the text of CSV files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"

namespace carom {

// What the rows are to be.
enum class CsvPairs : std::uint8_t { any, places };

// The rows "x,y" of a CSV text. Blank lines and lines that start with '#' are skipped; the first other line may be a
// header of two names, but not of "y,x", nor of velocities ("vx,vy") where rows are places. name stands for the file in
// messages, key for what is read. Throws InputError with "name:line: key: ..." for any line that is not two finite
// numbers.
std::vector<Vec2> parse_csv_pairs(std::string_view text, const std::string& name, std::string_view key,
                                  CsvPairs pairs = CsvPairs::any);

}  // namespace carom

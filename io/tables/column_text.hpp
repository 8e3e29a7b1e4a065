// The description of a column of series.csv, for docs/scene.md.
#pragma once

namespace carom {

struct ColumnText {
  const char* name;
  const char* unit;
  const char* meaning;
};

}  // namespace carom

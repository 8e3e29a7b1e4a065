// What docs/scene.md says of a column of series.csv.
#pragma once

namespace carom {

struct ColumnText {
  const char* name;
  const char* unit;
  const char* meaning;
};

}  // namespace carom

// Maps of where methods fail: dt against packing fraction for time stepping, and restitution against the number of
// disks for the collapse of exact.
#pragma once

#include <string>

namespace carom::stability {

// Write DIR/stability_dt.svg and .csv, and DIR/stability_collapse.svg and .csv. Without gnuplot only the CSV files are
// written.
void write_dt_map(const std::string& folder);
void write_collapse_map(const std::string& folder);

}  // namespace carom::stability

// Where methods break, as two maps: dt against packing fraction for time stepping, restitution against the number of
// disks for the collapse of exact.
#pragma once

#include <string>

namespace carom::stability {

// Write DIR/stability_dt.svg and .csv, DIR/stability_collapse.svg and .csv. Where gnuplot is not installed, the CSV
// only.
void write_dt_map(const std::string& folder);
void write_collapse_map(const std::string& folder);

}  // namespace carom::stability

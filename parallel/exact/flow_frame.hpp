// The frame in which disks of a sheared box are listed.
#pragma once

namespace carom {

// In a sheared box disks are listed by positions in a frame that moves with the flow: x - tilt (y - h / 2) in place of
// x, with a tilt that grows at the shear rate (the flow is at rest at half the height). In this frame the images above
// are at rest. Distances of touching disks are at most `stretch` times those in the box, until the tilt has grown by
// `strain` since the lists were built.
struct FlowFrame {
  bool acts = false;    // is the box sheared?
  double rate = 0.0;    // of the shear; 1 / time
  double middle = 0.0;  // height at which the flow is at rest; length
  double tilt = 0.0;    // at the start of the window
  double stretch = 1.0;
  double built_tilt = 0.0, built_at = 0.0;  // tilt and time of the run when the lists were built
  double strain = 0.0;

  double tilt_at(double s) const { return tilt + rate * s; }  // s: time in the window
  // x in this frame of a place at time s; length.
  double carried_back(double x, double y, double s) const { return x - tilt_at(s) * (y - middle); }
};

}  // namespace carom

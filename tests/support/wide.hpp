// More digits than a double has.
#pragma once

namespace carom::test {

// For formulas that Carom's are compared with.
using Wide = long double;
inline Wide wide(double x) {
  return static_cast<Wide>(x);
}

}  // namespace carom::test

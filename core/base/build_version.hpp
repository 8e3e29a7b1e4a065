// The version of the program with the commit that it was built from.
#pragma once

namespace carom {

// "0.1.0+g1a2b3c4"; "0.1.0+g1a2b3c4.dirty" where the program's sources differed from the commit; "0.1.0" where they
// came without git. Output files carry CAROM_VERSION instead, the version alone, so that equal runs leave equal files.
const char* build_version();

}  // namespace carom

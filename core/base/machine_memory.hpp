// How much memory this machine has.
#pragma once

namespace carom {

// Bytes of the machine's memory; infinity where it does not say.
double machine_memory();

}  // namespace carom

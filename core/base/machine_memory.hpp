// How much memory this machine has.
#pragma once

namespace carom {

// Bytes of the machine's memory; infinity where the system does not tell.
double machine_memory();

}  // namespace carom

// carom view --live: a run that is going on, in the browser.
#pragma once

#include "app/cli/command_line.hpp"

namespace carom {

// Serves until the run has ended and the pages that follow it have all its frames. Throws InputError if no run is going
// on, RunError if the system refuses to let it serve.
int view_live(const ViewOptions& options);

}  // namespace carom

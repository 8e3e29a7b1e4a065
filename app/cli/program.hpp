// The program but for what differs between one process and several ranks.
#pragma once

namespace carom {

class RankLead;

// Reads the command line, runs the command and turns every kind of error into one line and an exit status, which it
// returns. lead: of the ranks of which this process is the first; null where it is alone.
int program(int argc, char** argv, RankLead* lead);

}  // namespace carom

// The program but for what differs between one process and several ranks.
#pragma once

namespace carom {

class RankLead;

// Reads the command line, runs the command and turns every kind of error into one line and an exit status, which it
// returns. lead: of the ranks of which this process is the first; null where it is alone.
int program(int argc, char** argv, RankLead* lead);

// For a process that runs scenes and is not that program: a column of many disks is mapped by itself, so that it goes
// back to the system when it is freed. glibc would take to keeping up to 32 MiB, in pieces, once one of that size was
// freed.
void give_back_columns();

}  // namespace carom

// The program, for one process and for rank 0 of several.
#pragma once

namespace carom {

class RankLead;

// Reads the command line, runs the command, reports any error in one line, and returns the exit status. lead: of the
// ranks of which this process is rank 0; null if it is alone.
int program(int argc, char** argv, RankLead* lead);

// For other processes that run scenes: makes glibc allocate large columns as separate mappings, which return to the
// system when they are freed. By default it would keep freed blocks of up to 32 MiB.
void give_back_columns();

}  // namespace carom

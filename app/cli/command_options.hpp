// The options of each command, from the words given for them.
#pragma once

#include "app/cli/command_line.hpp"
#include "app/cli/option_words.hpp"

namespace carom {

// Each throws InputError if a word cannot be read, is out of range, or is missing.
RunOptions run_options(const OptionWords& words);
ResumeOptions resume_options(const OptionWords& words);
CheckOptions check_options(const OptionWords& words);
CompareOptions compare_options(const OptionWords& words);
RenderOptions render_options(const OptionWords& words);
ViewOptions view_options(const OptionWords& words);
SweepOptions sweep_options(const OptionWords& words);
ChartOptions chart_options(const OptionWords& words);
DocsOptions docs_options(const OptionWords& words);

}  // namespace carom

// The commands. Each returns the exit status, or throws one of the errors of core/base/check.hpp.
#pragma once

#include <vector>

#include "app/cli/command_line.hpp"
#include "run/results/json_keys.hpp"

namespace carom {

int command_run(const RunOptions& options);
int command_resume(const ResumeOptions& options);
int command_check(const CheckOptions& options);
int command_compare(const CompareOptions& options);
int command_render(const RenderOptions& options);
int command_view(const ViewOptions& options);
int command_sweep(const SweepOptions& options);
int command_chart(const ChartOptions& options);
int command_docs(const DocsOptions& options);

// The descriptions of the keys of compare --json, for docs/scene.md.
std::vector<KeyText> compare_key_texts();

}  // namespace carom

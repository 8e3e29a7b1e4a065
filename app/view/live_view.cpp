#include "app/view/live_view.hpp"

#include <fmt/format.h>

#include "app/cli/messages.hpp"
#include "app/view/live_run.hpp"
#include "app/view/open_page.hpp"
#include "core/base/input_message.hpp"

namespace carom {

namespace {

constexpr double reading_s = 0.25;  // until requests are served again
constexpr int serving_ms = 250;     // until the run is read again
constexpr double farewell_s = 2.0;  // after the end, without a request: pages have everything, or were closed

}  // namespace

int view_live(const ViewOptions& options) {
  if (options.file) fail_input("-o", "cannot be used with --live, which writes no file", "expected one of the two");
  ViewSettings settings;
  if (options.max_size) settings.most_bytes = *options.max_size;
  if (!options.quiet) settings.warn = print_warning;
  LiveRun run(options.source, settings);
  bool asked = false;
  LoopbackServer server([&](std::string_view path) {
    asked = true;
    return run.answer(path);
  });
  print_out(fmt::format("{}\n", server.link()));
  if (!options.quiet) print_note("the link works only on this computer, until Ctrl-C or the end of the run");
  if (options.open) open_page(server.link(), "--open", options.quiet);
  while (!run.ended()) {
    run.read(reading_s);
    server.serve(serving_ms);
  }
  while (asked && server.quiet_seconds() < farewell_s) server.serve(serving_ms);
  if (!options.quiet) print_note(run.state());
  return 0;
}

}  // namespace carom

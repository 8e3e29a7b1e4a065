// carom docs PAGE
#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/tools/scene_page.hpp"

namespace carom {

int command_docs(const DocsOptions& options) {
  switch (options.page) {
    case DocsOptions::Page::scene:
      print_out(scene_page());
  }
  return 0;
}

}  // namespace carom

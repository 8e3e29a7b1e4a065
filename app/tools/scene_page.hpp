// docs/scene.md, made from the tables that the reader and the writers use.
#pragma once

#include <string>

namespace carom {

std::string scene_page();

}  // namespace carom

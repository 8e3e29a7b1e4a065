// A scene from the C interface's struct.
#pragma once

#include <carom/carom.h>

#include "core/scene/scene.hpp"

namespace carom {

// The scene that such a file would give, without disks. Throws InputError, as for a file.
Scene scene_of_struct(const carom_scene& told);

}  // namespace carom

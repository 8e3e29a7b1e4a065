// Makes a scene from the struct of the C interface.
#pragma once

#include <carom/carom.h>

#include "core/scene/scene.hpp"

namespace carom {

// The scene that a file with these values would give, without disks. Throws InputError as for a file.
Scene scene_of_struct(const carom_scene& told);

}  // namespace carom

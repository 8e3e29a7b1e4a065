// The bounds of what movies and pictures may look like, for scenes and for carom render.
#pragma once

#include <string>

#include "core/scene/scene.hpp"

namespace carom {

// What is expected instead of such a look, in words; empty where it is good. docs/scene.md names the bounds.
std::string complaint_of_fps(double fps);
std::string complaint_of_size(double width, double height);
std::string complaint_of_range(ColourBy colour, double low, double high);

}  // namespace carom

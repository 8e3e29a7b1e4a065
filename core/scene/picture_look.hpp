// The bounds of the settings of movies and pictures, for scenes and for carom render.
#pragma once

#include <string>

#include "core/scene/scene.hpp"

namespace carom {

// The text of what is expected instead of this value; empty if it is within the bounds of docs/scene.md.
std::string complaint_of_fps(double fps);
std::string complaint_of_size(double width, double height);
std::string complaint_of_range(ColourBy colour, double low, double high);

}  // namespace carom

#pragma once

#include "render/raster/instance.h"

#include <string>

namespace offstage {

/// The GLSL functions that Quad, Arrow, Strip and Elbow need, for shader_sources.cpp.
std::string pathFunctions(Coverage coverage);
/// The expression of the part of the pixel that is covered.
const char* pathExpression(Coverage coverage);

} // namespace offstage

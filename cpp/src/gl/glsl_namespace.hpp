// A namespace for GLSL, which has none: two instances of one library in a shader, such as the
// look-up in a light's maps and in the camera's.
#pragma once

#include <string>
#include <string_view>

namespace opacity::gl {

// "u_layers" becomes "u_camera_layers", "Receiver" becomes "camera_Receiver": the letter that says
// what kind of input a name is stays in front.
std::string in_namespace(std::string_view name, std::string_view space);

// The text with every name that it declares at file scope, and every symbol that its #if lines ask
// for, in the namespace. Members of structures, parameters and what it takes from elsewhere stay.
std::string text_in_namespace(const std::string& text, std::string_view space);

}  // namespace opacity::gl

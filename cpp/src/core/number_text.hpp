// Numbers in messages: as short as they can be and still read back as the same number.
#pragma once

#include <string>

namespace opacity {

std::string number_text(double value);
// 0.1f is 0.1 here, and not the 0.10000000149011612 that it is as a double.
std::string number_text(float value);

}  // namespace opacity

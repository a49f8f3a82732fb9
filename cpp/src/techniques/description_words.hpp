// The words of a technique's description, and what they stand for.
#pragma once

#include <map>
#include <string>

#include "opacity/graph/pass.hpp"

namespace opacity::techniques {

template <class T>
using Words = std::map<std::string, T>;

inline const Words<Format> format_words{
    {"depth32f", Format::depth32f}, {"r32f", Format::r32f},   {"rgba32f", Format::rgba32f},
    {"rgba16f", Format::rgba16f},   {"rgba8", Format::rgba8}, {"r32ui", Format::r32ui},
    {"rgba32ui", Format::rgba32ui},
};
inline const Words<Depth> depth_words{
    {"off", Depth::off}, {"less", Depth::less}, {"greater", Depth::greater}};
inline const Words<Blend> blend_words{{"off", Blend::off}, {"add", Blend::add}};

}  // namespace opacity::techniques

#include "io/mtl.hpp"

#include <algorithm>
#include <array>

#include "core/number_text.hpp"
#include "io/file.hpp"
#include "io/text_cursor.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

float checked(TextCursor& cursor, const char* what, const Allowed& allowed) {
    const double value = cursor.number(what);
    if (allowed(value)) return float(value);
    throw cursor.error(
        std::string{what} + " is " + number_text(value) + ", which is not " + allowed.words,
        std::string{"write a value that is "} + allowed.words);
}

// "Kd r g b"; one number is a grey. Taken as linear, as the specification's own arithmetic does.
void read_color(TextCursor cursor, Material& material) {
    TextCursor ahead = cursor;
    const std::string_view first = ahead.word();
    if (first == "spectral" || first == "xyz") return;  // rare, and needs tables: the grey stays
    float3& color = material.color.emplace();
    color.fill(checked(cursor, "Kd", brightness));
    if (ahead.word().empty()) return;
    color[1] = checked(cursor, "Kd", brightness);
    color[2] = checked(cursor, "Kd", brightness);
}

// "d 0.7" or "d -halo 0.7", whose fall-off toward the edges is left out.
float read_factor(TextCursor cursor, const char* what) {
    TextCursor ahead = cursor;
    if (ahead.word() == "-halo") cursor.word();
    return checked(cursor, what, unit_interval);
}

struct MapOption {
    std::string_view name;
    int arguments;
};
// Those of three may have fewer, and are numbers.
constexpr std::array<MapOption, 13> map_options{{{"-blendu", 1},
                                                 {"-blendv", 1},
                                                 {"-boost", 1},
                                                 {"-mm", 2},
                                                 {"-texres", 1},
                                                 {"-clamp", 1},
                                                 {"-bm", 1},
                                                 {"-cc", 1},
                                                 {"-imfchan", 1},
                                                 {"-type", 1},
                                                 {"-s", 3},
                                                 {"-o", 3},
                                                 {"-t", 3}}};

bool is_number(std::string_view word) {
    constexpr std::string_view digits = "+-.0123456789eE";
    return !word.empty() && word.find_first_not_of(digits) == word.npos;
}

// "-imfchan m -s 1 1 1 leaf one.png": options, then a name that may hold spaces. Where a map is
// moved or scaled is left out.
MaterialMap read_map(TextCursor cursor) {
    MaterialMap map;
    for (;;) {
        TextCursor ahead = cursor;
        const std::string_view word = ahead.word();
        const auto option = std::find_if(map_options.begin(), map_options.end(),
                                         [&](const MapOption& o) { return o.name == word; });
        if (option == map_options.end()) break;
        cursor = ahead;
        for (int i = 0; i < option->arguments; ++i) {
            const std::string_view argument = ahead.word();
            if (option->arguments == 3 && !is_number(argument)) break;
            if (option->name == "-imfchan" && !argument.empty()) map.channel = argument[0];
            cursor = ahead;
        }
    }
    map.file = cursor.rest();
    return map;
}

}  // namespace

void read_mtl(const std::filesystem::path& path, Materials& materials) {
    const std::string text = read_text(path);
    TextCursor cursor{path, text};
    Material unnamed;
    Material* material = &unnamed;
    bool has_dissolve = false;
    while (cursor.next_statement()) {
        const std::string_view keyword = cursor.word();
        if (keyword == "newmtl") {
            material = &(materials[std::string{cursor.rest()}] = Material{});
            has_dissolve = false;
        } else if (keyword == "Kd") {
            read_color(cursor, *material);
        } else if (keyword == "d") {
            material->opacity = read_factor(cursor, "d");
            has_dissolve = true;
        } else if (keyword == "Tr" && !has_dissolve) {
            // Some exporters write the opacity as Tr as well: where both stand, d is the one to
            // trust.
            material->opacity = 1.f - read_factor(cursor, "Tr");
        } else if (keyword == "map_Kd") {
            material->color_map = read_map(cursor);
        } else if (keyword == "map_d") {
            material->alpha_map = read_map(cursor);
        }
    }
}

}  // namespace opacity

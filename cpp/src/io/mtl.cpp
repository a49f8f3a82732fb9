#include "io/mtl.hpp"

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
    material.color.fill(checked(cursor, "Kd", brightness));
    if (ahead.word().empty()) return;
    material.color[1] = checked(cursor, "Kd", brightness);
    material.color[2] = checked(cursor, "Kd", brightness);
}

// "d 0.7" or "d -halo 0.7", whose fall-off toward the edges is left out.
float read_factor(TextCursor cursor, const char* what) {
    TextCursor ahead = cursor;
    if (ahead.word() == "-halo") cursor.word();
    return checked(cursor, what, unit_interval);
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
        }
    }
}

}  // namespace opacity

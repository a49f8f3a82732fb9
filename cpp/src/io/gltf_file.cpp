// glTF 2.0: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include "io/gltf_file.hpp"

#include <algorithm>

#include "io/base64.hpp"
#include "io/file.hpp"

namespace opacity {
namespace {

constexpr const char* copy_again =
    "the file is damaged or was not written to the end: export or copy it again";

std::uint32_t word(std::string_view content, std::size_t at) {
    return scalar_at<std::uint32_t>(std::as_bytes(std::span{content}).data() + at,
                                    std::endian::little);
}

Bytes bytes_of(std::string_view content) {
    return std::as_bytes(std::span{content});
}

// "leaf%20one.bin" as it is called on disk.
std::string percent_decoded(std::string_view uri) {
    const auto digit = [](char c) {
        const std::size_t at = std::string_view{"0123456789abcdefABCDEF"}.find(c);
        return at == std::string_view::npos ? -1 : int(at < 16 ? at : at - 6);
    };
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escape =
            uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
        name.push_back(escape ? char(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i]);
        if (escape) i += 2;
    }
    return name;
}

struct ComponentType {
    std::uint64_t code;
    ScalarType type;
    double largest;  // what a normalized 1 is stored as; 0 for floats
};
constexpr ComponentType component_types[] = {
    {5120, ScalarType::int8, 127},    {5121, ScalarType::uint8, 255},
    {5122, ScalarType::int16, 32767}, {5123, ScalarType::uint16, 65535},
    {5125, ScalarType::uint32, 0},    {5126, ScalarType::float32, 0}};

struct ElementType {
    std::string_view name;
    std::size_t components;
};
constexpr ElementType element_types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};

// The row of a table that `is` accepts, or an error that names what the file says.
template <class Row, std::size_t n, class Is>
const Row& row_of(const Row (&table)[n], const Is& is, const JsonValue& value) {
    const auto found = std::find_if(std::begin(table), std::end(table), is);
    if (found == std::end(table))
        throw value.error("is not a type that is read",
                          "export scalars and vectors of the types that glTF 2.0 has");
    return *found;
}

}  // namespace

double GltfAccessor::value(std::size_t element, std::size_t component) const {
    const double value =
        scalar_at(data + element * stride + component * size_of(type), type, std::endian::little);
    if (!normalized) return value;
    const auto row = std::find_if(std::begin(component_types), std::end(component_types),
                                  [this](const ComponentType& t) { return t.type == type; });
    return row->largest == 0 ? value : std::max(value / row->largest, -1.0);
}

GltfFile::GltfFile(const std::filesystem::path& path, ModelFolder& folder)
    : folder_{folder}, content_{read_text(path)} {
    const std::string name = path.string();
    const std::string_view text = content_.starts_with("glTF") ? read_container(name) : content_;
    document_.emplace(text, name);
    const std::string_view version = root()["asset"]["version"].text("");
    if (!version.starts_with("2."))
        throw root()["asset"]["version"].error("is not 2.0", "export the model as glTF 2.0");
    // Quantized positions are read like all others.
    const JsonValue required = root()["extensionsRequired"];
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string_view extension = required[i].text("");
        if (extension != "KHR_mesh_quantization" && extension != "KHR_texture_transform")
            throw required.error("names " + std::string{extension} + ", which is not read",
                                 "export the model without it");
    }
    constexpr std::uint64_t always = 1 << 26;
    left_ = always + 16 * std::uint64_t{content_.size()};
    image_bytes_left_ = content_.size();
}

// A header of 12 bytes, the document, and perhaps the bytes of buffer 0; what follows is not known.
std::string_view GltfFile::read_container(const std::string& name) {
    const std::string_view content = content_;
    const auto refuse = [&](const std::string& problem) {
        throw FileFormatError(name + " " + problem, copy_again);
    };
    if (content.size() < 20)
        refuse("has " + std::to_string(content.size()) + " bytes; a GLB has 20 or more");
    if (word(content, 4) != 2) refuse("is not of version 2 of GLB");
    if (word(content, 8) != content.size())
        refuse("has " + std::to_string(content.size()) + " bytes; its header announces " +
               std::to_string(word(content, 8)));
    std::string_view document;
    for (std::size_t at = 12, chunk = 0; at < content.size(); ++chunk) {
        const std::size_t left = content.size() - at;
        if (left < 8 || word(content, at) > left - 8) refuse("ends within a chunk");
        const std::string_view type = content.substr(at + 4, 4);
        const std::string_view body = content.substr(at + 8, word(content, at));
        if (chunk == 0 && type == "JSON") document = body;
        if (chunk == 1 && type == std::string_view{"BIN\0", 4}) {
            binary_chunk_ = bytes_of(body);
            has_binary_chunk_ = true;
        }
        at += 8 + body.size();
    }
    if (document.empty()) refuse("does not begin with a document");
    return document;
}

std::size_t GltfFile::index_of(const char* array, const JsonValue& index) const {
    const std::uint64_t number = index.whole_number();
    const std::size_t count = root()[array].size();
    if (number < count) return std::size_t(number);
    throw index.error(
        "is " + std::to_string(number) + ", of " + std::to_string(count) + " " + array,
        "repair the file, or export it again");
}

JsonValue GltfFile::item(const char* array, const JsonValue& index) const {
    return root()[array][index_of(array, index)];
}

void GltfFile::spend(std::uint64_t bytes) {
    if (bytes > left_)
        throw root().error("unfolds to far more than its own size",
                           "export each mesh with vertices of its own, and fewer instances");
    left_ -= bytes;
}

Bytes GltfFile::embedded(std::string_view uri, const JsonValue& where) {
    const std::size_t comma = uri.find(";base64,");
    std::optional<std::string> decoded;
    if (comma != uri.npos) decoded = base64_decoded(uri.substr(comma + 8));
    if (!decoded) throw where.error("holds a data URI that is not base64", copy_again);
    return bytes_of(contents_[where.where()] = std::move(*decoded));
}

Bytes GltfFile::neighbour(std::string_view uri, const JsonValue& where) {
    const std::string name = percent_decoded(uri);
    const std::filesystem::path path = folder_.find(name);
    if (path.empty())
        throw where.error("names " + name.substr(0, 200) + ", which is not in its folder",
                          "put the file beside the model");
    const auto [found, is_new] = contents_.try_emplace(path.string());
    if (is_new) {
        found->second = read_text(path);
        left_ += 16 * std::uint64_t{found->second.size()};
        image_bytes_left_ += found->second.size();
    }
    return bytes_of(found->second);
}

Bytes GltfFile::buffer(const JsonValue& index) {
    const JsonValue buffer = item("buffers", index);
    const JsonValue uri = buffer["uri"];
    const std::string_view text = uri.text("");
    const auto known = contents_.find(uri.where());
    const bool first = index.whole_number() == 0;
    Bytes bytes = binary_chunk_;
    if (known != contents_.end())
        bytes = bytes_of(known->second);
    else if (uri)
        bytes = text.starts_with("data:") ? embedded(text, uri) : neighbour(text, uri);
    else if (!first || !has_binary_chunk_)
        throw buffer.error("has no bytes", copy_again);
    const std::uint64_t length = buffer["byteLength"].whole_number();
    if (length <= bytes.size()) return bytes.first(std::size_t(length));
    throw buffer.error(
        "announces " + std::to_string(length) + " bytes of " + std::to_string(bytes.size()),
        copy_again);
}

Bytes GltfFile::view(const JsonValue& index, std::size_t* stride) {
    const JsonValue view = item("bufferViews", index);
    const Bytes bytes = buffer(view["buffer"]);
    const std::uint64_t begin = view["byteOffset"].whole_number(0);
    const std::uint64_t length = view["byteLength"].whole_number();
    if (begin + length > bytes.size())
        throw view.error("ends at byte " + std::to_string(begin + length) + " of " +
                             std::to_string(bytes.size()),
                         copy_again);
    if (stride) *stride = std::size_t(view["byteStride"].whole_number(0));
    return bytes.subspan(std::size_t(begin), std::size_t(length));
}

GltfAccessor GltfFile::accessor(const JsonValue& index) {
    const JsonValue json = item("accessors", index);
    if (json["sparse"])
        throw json["sparse"].error("is not read", "export the model without sparse accessors");
    const JsonValue component = json["componentType"], element = json["type"];
    const std::uint64_t code = component.whole_number();
    const std::string_view name = element.text("");
    GltfAccessor accessor;
    accessor.type = row_of(
                        component_types, [&](auto& row) { return row.code == code; }, component)
                        .type;
    accessor.components = row_of(
                              element_types, [&](auto& row) { return row.name == name; }, element)
                              .components;
    accessor.normalized = json["normalized"].flag(false);
    const std::uint64_t count = json["count"].whole_number();
    const std::size_t size = accessor.components * size_of(accessor.type);
    const Bytes bytes = view(json["bufferView"], &accessor.stride);
    if (accessor.stride == 0) accessor.stride = size;
    const std::uint64_t begin = json["byteOffset"].whole_number(0);
    // No product wraps: a count is below 2^40, and a stride is checked first.
    if (accessor.stride < size || accessor.stride > 252 ||
        (count > 0 && begin + (count - 1) * accessor.stride + size > bytes.size()))
        throw json.error(
            "does not fit the " + std::to_string(bytes.size()) + " bytes of its buffer view",
            copy_again);
    accessor.data = bytes.data() + (count > 0 ? begin : 0);
    accessor.count = std::size_t(count);
    return accessor;
}

std::shared_ptr<PictureMaps> GltfFile::picture(const JsonValue& texture) {
    const JsonValue source = item("textures", texture)["source"];
    if (source) return image(source);
    folder_.warn(source.where() + " is missing: the picture is of a format that is not read");
    return nullptr;
}

std::shared_ptr<PictureMaps> GltfFile::image(const JsonValue& index) {
    const JsonValue image = item("images", index);
    const auto [found, is_new] = images_.try_emplace(index.whole_number());
    if (!is_new) return found->second;
    const JsonValue uri = image["uri"];
    const std::string_view text = uri.text("");
    if (uri && !text.starts_with("data:"))
        return found->second = folder_.picture(percent_decoded(text));
    const Bytes bytes = uri ? embedded(text, uri) : view(image["bufferView"]);
    // Each byte of a sound file belongs to one picture at most.
    if (bytes.size() > image_bytes_left_)
        throw image.error("shares its bytes with others", "name one image as often as it is used");
    image_bytes_left_ -= bytes.size();
    return found->second = std::make_shared<PictureMaps>(decode_picture(bytes, image.where()));
}

}  // namespace opacity

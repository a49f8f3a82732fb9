// A .gltf or .glb as a document and the bytes that it names.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/json_value.hpp"
#include "io/model_folder.hpp"
#include "io/scalar.hpp"

namespace opacity {

// Numbers in a buffer: `count` elements of so many components, each element `stride` bytes on.
struct GltfAccessor {
    const std::byte* data = nullptr;
    ScalarType type = ScalarType::float32;
    bool normalized = false;
    std::size_t components = 1, count = 0, stride = 0;

    // A normalized whole number as what it stands for, in 0 .. 1 or -1 .. 1.
    double value(std::size_t element, std::size_t component) const;
};

class GltfFile {
   public:
    GltfFile(const std::filesystem::path& path, ModelFolder& folder);

    JsonValue root() const { return document_->root(); }
    // The number of an element of one of the document's arrays, such as "meshes", and the element.
    std::size_t index_of(const char* array, const JsonValue& index) const;
    JsonValue item(const char* array, const JsonValue& index) const;

    GltfAccessor accessor(const JsonValue& index);
    // The picture of a texture; null, with a warning, where it is missing or not read.
    std::shared_ptr<PictureMaps> picture(const JsonValue& texture);

    // Counts what is made out of the content: parts may be shared, so that without a bound a small
    // file could ask for any amount of memory.
    void spend(std::uint64_t bytes);

   private:
    std::string_view read_container(const std::string& name);
    Bytes view(const JsonValue& index, std::size_t* stride = nullptr);
    Bytes buffer(const JsonValue& index);
    Bytes embedded(std::string_view uri, const JsonValue& where);
    Bytes neighbour(std::string_view uri, const JsonValue& where);
    std::shared_ptr<PictureMaps> image(const JsonValue& index);

    ModelFolder& folder_;
    std::string content_;
    Bytes binary_chunk_;
    bool has_binary_chunk_ = false;
    std::optional<JsonDocument> document_;
    std::uint64_t left_ = 0;
    std::map<std::string, std::string, std::less<>> contents_;  // of URIs, decoded or read
    std::map<std::uint64_t, std::shared_ptr<PictureMaps>> images_;
    std::uint64_t image_bytes_left_ = 0;
};

}  // namespace opacity

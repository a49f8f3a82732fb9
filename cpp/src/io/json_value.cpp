#include "io/json_value.hpp"

#include <nlohmann/json.hpp>

#include "scene/check.hpp"

namespace opacity {
namespace {

using Json = nlohmann::json;

constexpr const char* repair = "repair the file, or export it again";

}  // namespace

FileFormatError JsonValue::error(const std::string& problem, const std::string& fix) const {
    return {where_ + " " + problem, fix};
}

std::string JsonValue::wanted(std::size_t count) {
    return "write an array of " + std::to_string(count) + " numbers";
}

JsonValue JsonValue::operator[](const char* key) const {
    // The file's name ends in a colon: what is in it is named from there on.
    const std::string where = where_ + (where_.ends_with(':') ? " " : ".") + key;
    if (!value_) return {nullptr, where};
    if (!value_->is_object()) throw error("is not an object", repair);
    const auto found = value_->find(key);
    return {found == value_->end() ? nullptr : &*found, where};
}

std::size_t JsonValue::size() const {
    if (!value_) return 0;
    if (!value_->is_array()) throw error("is not an array", repair);
    return value_->size();
}

JsonValue JsonValue::operator[](std::size_t index) const {
    if (index >= size())
        throw error("has " + std::to_string(size()) + " elements, and number " +
                        std::to_string(index) + " (from 0) is asked for",
                    repair);
    return {&(*value_)[index], where_ + "[" + std::to_string(index) + "]"};
}

std::uint64_t JsonValue::whole_number() const {
    if (!value_) throw error("is missing", repair);
    constexpr std::uint64_t most = std::uint64_t{1} << 40;
    // Some exporters write 3.0.
    const double number = this->number(0.0);
    if (number >= 0.0 && number <= double(most) && number == double(std::uint64_t(number)))
        return std::uint64_t(number);
    throw error("is not a whole number from 0 on", repair);
}

std::uint64_t JsonValue::whole_number(std::uint64_t otherwise) const {
    return value_ ? whole_number() : otherwise;
}

double JsonValue::number(double otherwise) const {
    if (!value_) return otherwise;
    if (!value_->is_number()) throw error("is not a number", repair);
    const double number = value_->get<double>();
    if (!any_finite(number)) throw error("is too large a number", repair);
    return number;
}

bool JsonValue::flag(bool otherwise) const {
    if (!value_) return otherwise;
    if (!value_->is_boolean()) throw error("is neither true nor false", repair);
    return value_->get<bool>();
}

std::string_view JsonValue::text(std::string_view otherwise) const {
    if (!value_) return otherwise;
    if (!value_->is_string()) throw error("is not a text", repair);
    return value_->get_ref<const std::string&>();
}

JsonDocument::JsonDocument(std::string_view text, const std::string& name) : name_{name} {
    try {
        json_ = std::make_unique<Json>(Json::parse(text));
    } catch (const Json::parse_error& error) {
        throw FileFormatError(name + " is no JSON from byte " + std::to_string(error.byte) + " on",
                              "the file is damaged: export or copy it again");
    } catch (const Json::exception&) {  // a number that no double can hold
        throw FileFormatError(name + " holds a number that is too large", repair);
    }
}

JsonDocument::~JsonDocument() = default;

JsonValue JsonDocument::root() const {
    return {json_.get(), name_ + ":"};
}

}  // namespace opacity

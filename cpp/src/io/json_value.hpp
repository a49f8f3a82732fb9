// JSON whose every value knows where it stands, so that a complaint can name it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "opacity/core/error.hpp"

namespace opacity {

// What is asked of a value that is absent is its default; of one of another type an error.
class JsonValue {
   public:
    JsonValue(const nlohmann::json* value, std::string where)
        : value_{value}, where_{std::move(where)} {}

    explicit operator bool() const { return value_ != nullptr; }
    // "tree.glb: accessors[3]"
    const std::string& where() const { return where_; }
    FileFormatError error(const std::string& problem, const std::string& fix) const;

    JsonValue operator[](const char* key) const;
    // Of an array, which is empty where it is absent.
    std::size_t size() const;
    JsonValue operator[](std::size_t index) const;

    // At most 2^40, so that sums and small multiples fit 64 bits.
    std::uint64_t whole_number() const;
    std::uint64_t whole_number(std::uint64_t otherwise) const;
    double number(double otherwise) const;
    bool flag(bool otherwise) const;
    std::string_view text(std::string_view otherwise) const;
    template <std::size_t n>
    std::array<double, n> numbers(const std::array<double, n>& otherwise) const {
        if (!value_) return otherwise;
        if (size() != n) throw error("has " + std::to_string(size()) + " elements", wanted(n));
        std::array<double, n> values;
        for (std::size_t i = 0; i < n; ++i) values[i] = (*this)[i].number(0.0);
        return values;
    }

   private:
    static std::string wanted(std::size_t count);

    const nlohmann::json* value_;
    std::string where_;
};

class JsonDocument {
   public:
    // FileFormatError that begins with `name` where the text is not JSON.
    JsonDocument(std::string_view text, const std::string& name);
    ~JsonDocument();
    JsonDocument(const JsonDocument&) = delete;
    JsonDocument& operator=(const JsonDocument&) = delete;

    JsonValue root() const;

   private:
    std::unique_ptr<nlohmann::json> json_;
    std::string name_;
};

}  // namespace opacity

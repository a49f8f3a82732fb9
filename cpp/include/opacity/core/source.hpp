// A Source is anything that a pass can read. Its revision moves when, and only when, its content
// does; the frame graph runs a pass again only when the revision of a declared read has moved.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace opacity {

// Unique over the process: two equal revisions always mean the same content.
using Revision = std::uint64_t;

Revision next_revision() noexcept;

class Resource;

using UniformValue = std::variant<int, float, bool, std::vector<float>>;

// What a program takes its inputs from. A float vector of 2, 3, 4 fills a vector, any other size an
// array.
class Feeder {
   public:
    virtual ~Feeder() = default;
    virtual void uniform(std::string_view name, const UniformValue& value) = 0;
    virtual void resource(const Resource& resource) = 0;
};

class Source {
   public:
    explicit Source(std::string name) : name_{std::move(name)} {}
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
    virtual ~Source() = default;

    const std::string& name() const noexcept { return name_; }
    // The name in GLSL, without u_, t_, i_ or b_: "bounding_opacity_maps/start" is called start.
    std::string shader_name() const { return name_.substr(name_.rfind('/') + 1); }
    Revision revision() const noexcept { return revision_; }
    // Content that other code changed in place.
    void touch() noexcept { revision_ = next_revision(); }

    // Hands the content to a program, as uniforms u_<name>, samplers t_<name> or buffers b_<name>.
    virtual void feed(Feeder&) const {}

   private:
    std::string name_;
    Revision revision_ = next_revision();
};

// A value that the CPU computes. Setting what it already holds moves nothing: everything after it
// stays cached.
template <class T>
class Value : public Source {
   public:
    Value(std::string name, T initial) : Source{std::move(name)}, value_{std::move(initial)} {}

    const T& get() const noexcept { return value_; }
    void set(T value) {
        if (value == value_) return;
        value_ = std::move(value);
        touch();
    }
    // What no uniform can hold stays on the CPU.
    void feed([[maybe_unused]] Feeder& feeder) const override {
        if constexpr (std::is_constructible_v<UniformValue, const T&>)
            feeder.uniform("u_" + shader_name(), UniformValue{value_});
    }

   private:
    T value_;
};

}  // namespace opacity

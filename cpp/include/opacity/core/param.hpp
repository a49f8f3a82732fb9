// A parameter is one line of its owner, which gives range check, docs, Python attribute, uniform,
// revision and command-line option:
//     Param<int> layers{*this, "layers", 16, {1, 64}, "Opacity layers between the two bounds."};
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "opacity/core/param_owner.hpp"

namespace opacity {

template <class T>
struct Range {
    T min, max;
};

template <class T>  // int or double
class Param : public ParamBase {
   public:
    Param(ParamOwner& owner, std::string name, T initial, Range<T> range, std::string doc)
        : ParamBase{owner, std::move(name), std::move(doc)},
          value_{initial},
          default_{initial},
          range_{range} {}

    T get() const noexcept { return value_; }
    std::string type() const override;
    std::string range() const override;
    ParamValue value() const override;
    ParamValue default_value() const override;
    void assign(const ParamValue& value) override;
    void feed(Feeder& feeder) const override;

   private:
    T value_, default_;
    Range<T> range_;
};

template <>
class Param<bool> : public ParamBase {
   public:
    Param(ParamOwner& owner, std::string name, bool initial, std::string doc)
        : ParamBase{owner, std::move(name), std::move(doc)}, value_{initial}, default_{initial} {}

    bool get() const noexcept { return value_; }
    std::string type() const override { return "bool"; }
    std::string range() const override { return "true, false"; }
    ParamValue value() const override { return value_; }
    ParamValue default_value() const override { return default_; }
    void assign(const ParamValue& value) override;
    void feed(Feeder& feeder) const override { feeder.uniform("u_" + name(), value_); }

   private:
    bool value_, default_;
};

// One of several words.
class Choice : public ParamBase {
   public:
    Choice(ParamOwner& owner, std::string name, std::vector<std::string> choices, std::string doc)
        : ParamBase{owner, std::move(name), std::move(doc)}, choices_{std::move(choices)} {}

    const std::string& get() const noexcept { return choices_[index_]; }
    bool is(std::string_view choice) const noexcept { return get() == choice; }
    std::size_t index() const noexcept { return index_; }
    std::string type() const override { return "choice"; }
    std::string range() const override;
    ParamValue value() const override { return get(); }
    ParamValue default_value() const override { return choices_.front(); }
    void assign(const ParamValue& value) override;
    void feed(Feeder& feeder) const override { feeder.uniform("u_" + name(), int(index_)); }

   private:
    std::vector<std::string> choices_;  // the default first
    std::size_t index_ = 0;
};

// One of several whole numbers.
class IntChoice : public ParamBase {
   public:
    IntChoice(ParamOwner& owner, std::string name, std::vector<int> choices, std::string doc)
        : ParamBase{owner, std::move(name), std::move(doc)}, choices_{std::move(choices)} {}

    int get() const noexcept { return choices_[index_]; }
    std::string type() const override { return "int"; }
    std::string range() const override;
    ParamValue value() const override { return std::int64_t{get()}; }
    ParamValue default_value() const override { return std::int64_t{choices_.front()}; }
    void assign(const ParamValue& value) override;
    void feed(Feeder& feeder) const override { feeder.uniform("u_" + name(), get()); }

   private:
    std::vector<int> choices_;  // the default first
    std::size_t index_ = 0;
};

// A number, or "auto": found from the scene. The uniform is negative for auto.
template <class T>  // int or double
class AutoParam : public ParamBase {
   public:
    AutoParam(ParamOwner& owner, std::string name, Range<T> range, std::string doc)
        : AutoParam{owner, std::move(name), automatic, range, std::move(doc)} {}
    AutoParam(ParamOwner& owner, std::string name, T initial, Range<T> range, std::string doc)
        : ParamBase{owner, std::move(name), std::move(doc)},
          value_{initial},
          default_{initial},
          range_{range} {}

    bool is_auto() const noexcept { return value_ < T(0); }
    T get() const noexcept { return value_; }
    std::string type() const override;
    std::string range() const override;
    ParamValue value() const override { return shown(value_); }
    ParamValue default_value() const override { return shown(default_); }
    void assign(const ParamValue& value) override;
    void feed(Feeder& feeder) const override;

   private:
    static constexpr T automatic{-1};
    static ParamValue shown(T value);
    std::string number_range() const;

    T value_, default_;
    Range<T> range_;
};

}  // namespace opacity

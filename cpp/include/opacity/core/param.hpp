// A parameter is one line of its owner, which gives range check, docs, Python attribute, uniform,
// revision and command-line option:
//     Param<int> layers{*this, "layers", 16, {1, 64}, "Opacity layers between the two bounds."};
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "opacity/core/source.hpp"

namespace opacity {

using ParamValue = std::variant<bool, std::int64_t, double, std::string>;

std::string to_string(const ParamValue& value);

class ParamOwner;

class ParamBase : public Source {
   public:
    ParamBase(ParamOwner& owner, std::string name, std::string doc);

    const std::string& doc() const noexcept { return doc_; }
    virtual std::string type() const = 0;   // "int", "float", "bool", "choice"
    virtual std::string range() const = 0;  // "1..64"
    virtual ParamValue value() const = 0;
    virtual ParamValue default_value() const = 0;
    virtual void assign(const ParamValue& value) = 0;  // ParameterError for what does not fit

   protected:
    // "technique.layers = 400 is outside 1..64": `problem` is what follows "is".
    [[noreturn]] void reject(const ParamValue& value, const std::string& problem) const;
    [[noreturn]] void reject_type(const ParamValue& value) const;

   private:
    ParamOwner& owner_;
    std::string doc_;
};

// Whoever has parameters: a technique, the renderer.
class ParamOwner {
   public:
    explicit ParamOwner(std::string name) : name_{std::move(name)} {}
    ParamOwner(const ParamOwner&) = delete;
    ParamOwner& operator=(const ParamOwner&) = delete;
    virtual ~ParamOwner() = default;

    const std::string& name() const noexcept { return name_; }
    const std::vector<ParamBase*>& params() const noexcept { return params_; }
    // ParameterError that suggests the nearest name where there is none of this one.
    ParamBase& param(std::string_view name) const;

   private:
    friend class ParamBase;  // enters itself
    std::string name_;
    std::vector<ParamBase*> params_;
};

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

// A number, or "auto": found from the scene. The uniform is negative for auto.
class AutoParam : public ParamBase {
   public:
    AutoParam(ParamOwner& owner, std::string name, Range<double> range, std::string doc)
        : ParamBase{owner, std::move(name), std::move(doc)}, range_{range} {}

    bool is_auto() const noexcept { return value_ < 0.0; }
    double get() const noexcept { return value_; }
    std::string type() const override { return "float or \"auto\""; }
    std::string range() const override;
    ParamValue value() const override;
    ParamValue default_value() const override { return "auto"; }
    void assign(const ParamValue& value) override;
    void feed(Feeder& feeder) const override { feeder.uniform("u_" + name(), float(value_)); }

   private:
    std::string number_range() const;

    double value_ = -1.0;
    Range<double> range_;
};

}  // namespace opacity

// What has parameters, and what every parameter can do whatever its type.
#pragma once

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
    // `listed_by`: the command that shows its parameters to whoever got one wrong.
    ParamOwner(std::string name, std::string listed_by)
        : name_{std::move(name)}, listed_by_{std::move(listed_by)} {}
    ParamOwner(const ParamOwner&) = delete;
    ParamOwner& operator=(const ParamOwner&) = delete;
    virtual ~ParamOwner() = default;

    const std::string& name() const noexcept { return name_; }
    const std::vector<ParamBase*>& params() const noexcept { return params_; }
    // ParameterError that suggests the nearest name where there is none of this one.
    ParamBase& param(std::string_view name) const;

   private:
    friend class ParamBase;
    std::string name_, listed_by_;
    std::vector<ParamBase*> params_;
};

}  // namespace opacity

// Content that never changes, held by whoever copied it: a copy costs a pointer.
#pragma once

#include <memory>
#include <utility>

namespace opacity {

template <class T>
class Shared {
   public:
    Shared() : content_{std::make_shared<const T>()} {}
    Shared(T content) : content_{std::make_shared<const T>(std::move(content))} {}  // NOLINT

    const T& operator*() const { return *content_; }
    const T* operator->() const { return content_.get(); }

   private:
    std::shared_ptr<const T> content_;
};

}  // namespace opacity

// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_LAZY_H
#define LOCUS_FUNCTION_LAZY_H

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace locus {

/// A value that is made when it is first asked for; copies share it. Safe to ask from several threads at once.
template <class T>
class Lazy {
public:
  Lazy() : Lazy(T{}) {}
  Lazy(T value) : state_(std::make_shared<State>())
  {
    std::call_once(state_->made, [&] { state_->value = std::move(value); });
  }
  static Lazy from(std::function<T()> make)
  {
    Lazy lazy(Unmade{});
    lazy.state_->make = std::move(make);
    return lazy;
  }

  const T& get() const
  {
    std::call_once(state_->made, [&] { state_->value = state_->make(); });
    return state_->value;
  }

private:
  struct Unmade {};
  explicit Lazy(Unmade) : state_(std::make_shared<State>()) {}

  struct State {
    std::once_flag made;
    std::function<T()> make;
    T value;
  };
  std::shared_ptr<State> state_;
};

} // namespace locus

#endif

#pragma once

#include <memory>
#include <typeindex>
#include <unordered_map>
#include <utility>

#include "answers/analysis_context.hpp"
#include "base/requires.hpp"

namespace coordreq {

/// The results of the analysis of one problem: the context, and the values of answers, each of a type of its
/// own.
///
/// Values keep their addresses once they have been added, and may refer to one another.
class Answers {
 public:
  /// @param ranks the processes that share the work; null: there is one
  /// @pre unchecked: both outlive this object
  explicit Answers(const Model& model, Ranks* ranks = nullptr) : context(model, ranks) {}
  Answers(const Answers&) = delete;
  Answers& operator=(const Answers&) = delete;

  /// @pre there is no value of this type yet
  template <class Value>
  Value& add(Value value) {
    REQUIRES(find<Value>() == nullptr);
    auto owned = std::make_shared<Value>(std::move(value));
    Value& result = *owned;
    values_.emplace(typeid(Value), std::move(owned));
    return result;
  }
  /// Null if the value has not been found, or was not asked for.
  template <class Value>
  [[nodiscard]] const Value* find() const {
    const auto found = values_.find(typeid(Value));
    return found == values_.end() ? nullptr : static_cast<const Value*>(found->second.get());
  }
  /// @pre there is a value of this type
  template <class Value>
  [[nodiscard]] const Value& get() const {
    REQUIRES(find<Value>() != nullptr);
    return *find<Value>();
  }
  template <class Value>
  [[nodiscard]] Value& get() {
    return *static_cast<Value*>(values_.at(typeid(Value)).get());
  }

  AnalysisContext context;

 private:
  std::unordered_map<std::type_index, std::shared_ptr<void>> values_;
};

}  // namespace coordreq

// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_INVALID_INPUT_H
#define LOCUS_SHAPE_INVALID_INPUT_H

#include <stdexcept>
#include <string>

namespace locus {

/// An input breaks a rule. The message names the place, the rule and the remedy; `what()` is one line.
class Invalid_input : public std::invalid_argument {
public:
  Invalid_input(const std::string& place, const std::string& rule, const std::string& remedy)
    : std::invalid_argument((place.empty() ? "" : place + ": ") + rule + "; " + remedy), place_(place), rule_(rule),
      remedy_(remedy)
  {
  }

  const std::string& place() const { return place_; }
  const std::string& rule() const { return rule_; }
  const std::string& remedy() const { return remedy_; }

  /// The same complaint, told of an input further out: "inputs[1].curve" + ".weights[2]".
  Invalid_input within(const std::string& outer) const { return {outer + place_, rule_, remedy_}; }

private:
  std::string place_, rule_, remedy_;
};

/// A valid request for something this version does not do yet. The message names the feature.
class Unsupported_feature : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

} // namespace locus

#endif

#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// What answers are made of: numbers, words and lists of results.json, which may be missing there, as sentences.
  namespace answer_parts
  {
    using Json = nlohmann::ordered_json;
    using Lines = std::vector<std::string>;

    /// at most so many roots, fits, bodies are said one by one
    constexpr std::size_t most_said = 6;

    /// As std::printf().
    __attribute__((format(printf, 1, 2))) std::string text(const char *form, ...);
    double number(const Json &json, const std::string &name, double otherwise = 0);
    /// empty: none
    std::string word(const Json &json, const std::string &name);
    /// empty: none
    const Json &list(const Json &json, const std::string &name);
    bool is_given(const Json &json, const std::string &name);
    /// The entry whose number, times the sign, is the largest; null if there are none.
    const Json *largest(const Json &entries, const std::string &name, double sign);
    /// How many of n were not said.
    void say_more(std::size_t n, const std::string &what, Lines &lines);
  } // namespace answer_parts
} // namespace vibrocontact

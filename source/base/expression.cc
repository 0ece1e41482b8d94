#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/expression.h>

#include <deal.II/base/function_parser.h>

#include <iostream>
#include <memory>

namespace vibrocontact
{
  namespace
  {
    /// Nothing reaches standard error while it lives.
    struct QuietErrors
    {
      QuietErrors() : kept(std::cerr.rdbuf(nullptr)) {}
      ~QuietErrors()
      {
        std::cerr.rdbuf(kept);
        std::cerr.clear();
      }
      std::streambuf *const kept;
    };

    /// muparser takes a comma outside of parentheses as the end of one expression and the beginning of another.
    bool has_lone_comma(const std::string &expression)
    {
      int depth = 0;
      for (const char c : expression)
      {
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (c == ',' && depth <= 0)
          return true;
      }
      return false;
    }
  } // namespace

  std::function<double(double)> read_expression(const std::string &expression, const std::string &variable,
                                                const std::string &entry, const std::string &meaning)
  {
    if (has_lone_comma(expression))
      throw InputError("Entry " + entry + " is '" + expression +
                       "', which has a comma outside of parentheses: write decimals with a point.");
    const auto parser = std::make_shared<dealii::FunctionParser<1>>();
    const QuietErrors quiet; // deal.II prints the parser's words itself
    try
    {
      parser->initialize(variable, expression, {{"pi", dealii::numbers::PI}}, false);
      parser->value(dealii::Point<1>(0.));
    }
    catch (const dealii::ExceptionBase &)
    {
      throw InputError("Entry " + entry + " is '" + expression + "', which is no expression of " + meaning +
                       ".");
    }
    return [parser](const double value) { return parser->value(dealii::Point<1>(value)); };
  }
} // namespace vibrocontact

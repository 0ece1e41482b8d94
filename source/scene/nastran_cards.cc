#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/text_lines.h>
#include <vibrocontact/base/utf8.h>
#include <vibrocontact/scene/nastran_cards.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// A field cuts where it ends, be it in the middle of a letter.
    std::string cleaned(const std::string_view text)
    {
      return trimmed(as_utf8(std::string(text)));
    }

    /// The fields of one line behind its first, and the first.
    struct Line
    {
      std::string first;
      std::vector<std::string> fields;
    };

    Line fields_of(const std::string_view text)
    {
      Line result;
      if (text.find(',') != std::string_view::npos)
      {
        std::size_t begin = 0;
        std::vector<std::string> cells;
        while (begin <= text.size())
        {
          const std::size_t end = std::min(text.find(',', begin), text.size());
          cells.push_back(cleaned(text.substr(begin, end - begin)));
          begin = end + 1;
        }
        result.first = cells[0];
        cells.erase(cells.begin());
        cells.resize(result.first.find('*') != std::string::npos ? 4 : 8);
        result.fields = cells;
        return result;
      }
      result.first = cleaned(text.substr(0, 8));
      const bool is_long = result.first.find('*') != std::string::npos;
      const std::size_t width = is_long ? 16 : 8, n = is_long ? 4 : 8;
      for (std::size_t k = 0; k < n; ++k)
      {
        const std::size_t begin = 8 + k * width;
        result.fields.push_back(begin < text.size() ? cleaned(text.substr(begin, width)) : "");
      }
      return result;
    }

    bool continues(const std::string &first)
    {
      return first.empty() || first[0] == '+' || first[0] == '*';
    }
  } // namespace

  const std::string &NastranCard::field(const std::size_t k) const
  {
    static const std::string none;
    return k < fields.size() ? fields[k] : none;
  }

  std::string NastranCard::where(const std::size_t k) const
  {
    return source + ", line " + std::to_string(lines.empty() ? 0 : lines[std::min(k, lines.size() - 1)]) +
           ",";
  }

  double NastranCard::number(const std::size_t k) const
  {
    std::string text = field(k);
    for (char &c : text)
      if (c == 'd' || c == 'D')
        c = 'e';
    // an exponent without its letter
    const std::size_t sign = text.find_last_of("+-");
    if (sign != std::string::npos && sign > 0 && text.find_first_of("eE") == std::string::npos)
      text.insert(sign, "e");
    // "1.e+3" has a sign that only the mantissa may not have
    double value = 0;
    if (!is_number(text, value) || !std::isfinite(value))
      throw InputError(where(k) + " has '" + field(k) + "' where a finite number is due.");
    return value;
  }

  unsigned long NastranCard::count(const std::size_t k) const
  {
    unsigned long value = 0;
    if (!is_count(field(k), value))
      throw InputError(where(k) + " has '" + field(k) + "' where a whole number is due.");
    return value;
  }

  void for_each_card(const std::string &source, const std::string &bytes,
                     const std::vector<std::string> &names,
                     const std::function<void(const NastranCard &)> &take)
  {
    NastranCard card;
    card.source = source;
    bool wanted = false;
    const auto finish = [&]
    {
      if (wanted)
        take(card);
      wanted = false;
    };
    TextLines lines(source, bytes);
    while (lines.next())
    {
      const std::string_view text = lines.line().substr(0, lines.line().find('$'));
      if (cleaned(text).empty())
        continue;
      const Line line = fields_of(text);
      if (!continues(line.first))
      {
        finish();
        card.name = line.first.substr(0, line.first.find('*'));
        boost::to_upper(card.name);
        wanted = std::find(names.begin(), names.end(), card.name) != names.end();
        card.fields.clear();
        card.lines.clear();
      }
      if (!wanted)
        continue;
      card.fields.insert(card.fields.end(), line.fields.begin(), line.fields.end());
      card.lines.insert(card.lines.end(), line.fields.size(), lines.number());
    }
    finish();
  }

  NodePlaces read_grid_cards(const std::string &source, const std::string &bytes)
  {
    NodePlaces places;
    for_each_card(source, bytes, {"GRID"},
                  [&](const NastranCard &card)
                  {
                    const unsigned long node = card.count(0);
                    for (const unsigned int system : {1u, 5u})
                      if (!card.field(system).empty() && card.field(system) != "0")
                        throw InputError(card.where(system) + " gives node " + std::to_string(node) +
                                         " in coordinate system " + card.field(system) +
                                         ": the program knows the basic one alone; write places and "
                                         "displacements in that.");
                    dealii::Point<3> place;
                    for (unsigned int d = 0; d < 3; ++d)
                      place[d] = card.field(2 + d).empty() ? 0. : card.number(2 + d);
                    if (!places.emplace(node, place).second)
                      throw InputError(card.where() + " gives node " + std::to_string(node) +
                                       " a second time: give each node one place.");
                  });
    return places;
  }
} // namespace vibrocontact

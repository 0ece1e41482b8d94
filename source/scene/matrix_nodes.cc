#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/text_lines.h>
#include <vibrocontact/scene/matrix_nodes.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace vibrocontact
{
  namespace
  {
    const std::vector<std::string> directions = {"x", "y", "z", "rx", "ry", "rz", "modal"};

    unsigned long node_number(const std::string &where, const std::string_view word)
    {
      unsigned long node = 0;
      if (!is_count(word, node) || node == 0)
        throw InputError(where + " has '" + std::string(word) + "' where the number of a node is due.");
      return node;
    }

    /// Columns of places: x, y, z or with the unit m behind them.
    std::vector<unsigned int> place_columns(const TextTable &table)
    {
      std::vector<unsigned int> result;
      const std::string unit = table.find("x_m") ? "_m" : "";
      for (const char *const axis : {"x", "y", "z"})
        result.push_back(table.column(axis + unit));
      return result;
    }

    dealii::Point<3> place(const TextTable &table, const unsigned int row,
                           const std::vector<unsigned int> &columns)
    {
      return dealii::Point<3>(table.number(row, columns[0]), table.number(row, columns[1]),
                              table.number(row, columns[2]));
    }

    void add_place(NodePlaces &places, const std::string &where, const unsigned long node,
                   const dealii::Point<3> &place)
    {
      const auto [found, is_new] = places.emplace(node, place);
      if (!is_new && found->second.distance(place) > 1e-9 * place.norm())
        throw InputError(where + " gives node " + std::to_string(node) +
                         " another place than a line before: give each node one.");
    }

    /// "a, b ,c" -> {a, b, c}
    std::vector<std::string> cells_of(const std::string_view line)
    {
      std::vector<std::string> cells;
      for (std::size_t first = 0; first <= line.size();)
      {
        const std::size_t end = std::min(line.find(',', first), line.size());
        cells.push_back(trimmed(std::string(line.substr(first, end - first))));
        first = end + 1;
      }
      return cells;
    }

    /// Value of an option of a keyword line: NSET=TOP -> TOP.
    std::string option(const std::vector<std::string> &cells, const std::string &name)
    {
      for (const std::string &cell : cells)
      {
        const std::size_t equals = cell.find('=');
        if (equals != std::string::npos && boost::to_upper_copy(trimmed(cell.substr(0, equals))) == name)
          return boost::to_upper_copy(trimmed(cell.substr(equals + 1)));
      }
      return "";
    }
  } // namespace

  std::string MatrixDof::text() const
  {
    return directions[direction] + " of node " + std::to_string(node);
  }

  MatrixDofs read_dof_table(const std::string &source, const std::string &bytes)
  {
    const TextTable table = read_text_table(source, bytes);
    const unsigned int node_column = table.column("node"), direction_column = table.column("direction");
    const std::vector<unsigned int> columns = place_columns(table);
    MatrixDofs result;
    result.nodes.in_metres = table.find("x_m").has_value();
    std::set<MatrixDof> seen;
    for (unsigned int row = 0; row < table.rows.size(); ++row)
    {
      const std::string where = source + ", line " + std::to_string(table.lines[row]) + ",";
      const std::string &word = table.rows[row][direction_column];
      const auto found = std::find(directions.begin(), directions.end(), word);
      if (found == directions.end())
        throw InputError(where + " has the direction '" + word + "': " + name_suggestion(word, directions) +
                         ".");
      MatrixDof dof;
      dof.node = node_number(where, table.rows[row][node_column]);
      dof.direction = found - directions.begin();
      if (!seen.insert(dof).second)
        throw InputError(where + " gives " + dof.text() + " a second time: give each dof one line.");
      if (dof.direction != MatrixDof::modal)
      {
        for (const unsigned int column : columns)
          if (table.rows[row][column].empty())
            throw InputError(where + " gives " + dof.text() + " without a place: give its " +
                             table.names[column] + ", or the direction modal if it is none of a node.");
        add_place(result.nodes.places, where, dof.node, place(table, row, columns));
      }
      result.dofs.push_back(dof);
    }
    return result;
  }

  NodeTable read_node_table(const std::string &source, const std::string &bytes)
  {
    const TextTable table = read_text_table(source, bytes);
    const unsigned int node_column = table.column("node");
    const std::vector<unsigned int> columns = place_columns(table);
    NodeTable nodes;
    nodes.in_metres = table.find("x_m").has_value();
    for (unsigned int row = 0; row < table.rows.size(); ++row)
    {
      const std::string where = source + ", line " + std::to_string(table.lines[row]) + ",";
      add_place(nodes.places, where, node_number(where, table.rows[row][node_column]),
                place(table, row, columns));
    }
    return nodes;
  }

  NodeGroups read_group_table(const std::string &source, const std::string &bytes)
  {
    const TextTable table = read_text_table(source, bytes);
    const unsigned int group_column = table.column("group"), node_column = table.column("node");
    NodeGroups groups;
    for (unsigned int row = 0; row < table.rows.size(); ++row)
    {
      const std::string where = source + ", line " + std::to_string(table.lines[row]) + ",";
      if (table.rows[row][group_column].empty())
        throw InputError(where + " has no name of a group: give one in every line.");
      groups[table.rows[row][group_column]].push_back(node_number(where, table.rows[row][node_column]));
    }
    return groups;
  }

  std::vector<MatrixDof> read_calculix_dofs(const std::string &source, const std::string &bytes)
  {
    std::vector<MatrixDof> dofs;
    std::set<MatrixDof> seen;
    TextLines lines(source, bytes);
    while (lines.next())
    {
      std::string_view rest = lines.line();
      const std::string_view word = next_word(rest);
      if (word.empty())
        continue;
      const std::size_t point = word.find('.');
      unsigned long direction = 0;
      if (point == std::string_view::npos || !is_count(word.substr(point + 1), direction) || direction < 1 ||
          direction > 6)
        throw InputError(lines.where() + ", has '" + std::string(word) +
                         "' where a dof such as 12.3 is due, the third direction of node 12.");
      const MatrixDof dof = {node_number(lines.where() + ",", word.substr(0, point)),
                             static_cast<unsigned int>(direction - 1)};
      if (!seen.insert(dof).second)
        throw InputError(lines.where() + ", gives " + dof.text() + " a second time: give each dof one line.");
      dofs.push_back(dof);
    }
    return dofs;
  }

  DeckNodes read_deck(const std::string &source, const std::string &bytes)
  {
    DeckNodes deck;
    enum class Reading
    {
      nothing,
      nodes,
      set
    } reading = Reading::nothing;
    std::vector<unsigned long> *group = nullptr;
    bool ranges = false;
    TextLines lines(source, bytes);
    // sets of sets and ranges make much of few lines
    unsigned long n_generated = 0;
    const auto check_size = [&](const unsigned long n)
    {
      constexpr unsigned long most = 10'000'000;
      if (n > most || (n_generated += n) > most)
        throw InputError(lines.where() + ", brings the sets to more than " + std::to_string(most) +
                         " nodes: the deck is damaged, or leave out what is not needed.");
    };
    while (lines.next())
    {
      const std::vector<std::string> cells = cells_of(lines.line());
      const std::string &first = cells[0];
      const std::string where = lines.where() + ",";
      if (first.rfind("**", 0) == 0 || (cells.size() == 1 && first.empty()))
        continue;
      if (first[0] == '*')
      {
        const std::string keyword = boost::to_upper_copy(std::string(first)), set = option(cells, "NSET");
        reading = keyword == "*NODE" ? Reading::nodes : keyword == "*NSET" ? Reading::set : Reading::nothing;
        if (keyword == "*NSET" && set.empty())
          throw InputError(where + " has no name: write *NSET, NSET=name.");
        group = set.empty() || reading == Reading::nothing ? nullptr : &deck.groups[set];
        ranges = std::any_of(cells.begin(), cells.end(),
                             [](const std::string &cell)
                             { return boost::to_upper_copy(std::string(cell)) == "GENERATE"; });
        continue;
      }
      if (reading == Reading::nodes)
      {
        const unsigned long node = node_number(where, first);
        dealii::Point<3> place;
        for (unsigned int d = 0; d < 3 && d + 1 < cells.size(); ++d)
          if (!cells[d + 1].empty() && (!is_number(cells[d + 1], place[d]) || !std::isfinite(place[d])))
            throw InputError(where + " has '" + cells[d + 1] + "' where a coordinate of node " +
                             std::to_string(node) + " is due.");
        add_place(deck.places, where, node, place);
        if (group)
          group->push_back(node);
      }
      else if (reading == Reading::set && ranges)
      {
        const unsigned long begin = node_number(where, first),
                            end = cells.size() > 1 ? node_number(where, cells[1]) : begin;
        unsigned long step = 1;
        if (cells.size() > 2 && !cells[2].empty())
          step = node_number(where, cells[2]);
        if (end < begin)
          throw InputError(where + " ends before it begins: write first node, last node, step.");
        const unsigned long n = (end - begin) / step;
        check_size(n);
        for (unsigned long k = 0; k <= n; ++k)
          group->push_back(begin + k * step);
      }
      else if (reading == Reading::set)
        for (const std::string &cell : cells)
        {
          unsigned long node = 0;
          const auto other = deck.groups.find(boost::to_upper_copy(std::string(cell)));
          if (cell.empty())
            continue;
          if (is_count(cell, node))
            group->push_back(node);
          else if (other != deck.groups.end() && &other->second != group)
          {
            check_size(other->second.size());
            group->insert(group->end(), other->second.begin(), other->second.end());
          }
          else
            throw InputError(where + " has '" + cell +
                             "' where the number of a node or the name of a set before is due.");
        }
    }
    return deck;
  }
} // namespace vibrocontact

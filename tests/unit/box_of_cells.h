#pragma once

// Boxes of hexahedra, tetrahedra or prisms of first and second order, as decks of Abaqus and CalculiX.

#include <deal.II/base/point.h>

#include <array>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace vibrocontact
{
  struct BoxOfCells
  {
    /// C3D8, C3D20, C3D4, C3D10, C3D6, C3D15
    std::string type = "C3D8";
    /// of the cells beyond the middle of x, sharing faces with the others; empty: as these
    std::string other_type;
    std::array<unsigned int, 3> divisions = {{2, 2, 2}};
    /// place of a point of the unit cube, and whether edges follow it or stay straight
    std::function<dealii::Point<3>(const dealii::Point<3> &)> place = [](const dealii::Point<3> &p)
    { return p; };
    bool curved = false;
    /// written behind the cells and sets
    std::string more;
    /// of several boxes in a deck: in front of the sets' names, and added to all numbers
    std::string prefix;
    unsigned int offset = 0;

    /// Node sets of the faces: left, right, front, back, bottom, top.
    std::string text() const
    {
      using Index = std::array<unsigned int, 3>;
      // corners of a cube in Abaqus' order
      const std::vector<Index> cube = {{{0, 0, 0}}, {{2, 0, 0}}, {{2, 2, 0}}, {{0, 2, 0}},
                                       {{0, 0, 2}}, {{2, 0, 2}}, {{2, 2, 2}}, {{0, 2, 2}}};
      std::map<Index, unsigned int> number;
      std::ostringstream nodes;
      std::map<std::string, std::ostringstream> cells;
      nodes.precision(17);
      const auto at = [&](const Index &index)
      {
        dealii::Point<3> p;
        for (unsigned int d = 0; d < 3; ++d)
          p[d] = index[d] / (2. * divisions[d]);
        return place(p);
      };
      const auto node = [&](const Index &index, const dealii::Point<3> &p)
      {
        const auto [found, is_new] = number.emplace(index, offset + number.size() + 1);
        if (is_new)
          nodes << found->second << ", " << p[0] << ", " << p[1] << ", " << p[2] << "\n";
        return found->second;
      };
      unsigned int n_cells = 0;
      for (unsigned int k = 0; k < divisions[2]; ++k)
        for (unsigned int j = 0; j < divisions[1]; ++j)
          for (unsigned int i = 0; i < divisions[0]; ++i)
          {
            const std::string own = !other_type.empty() && 2 * i >= divisions[0] ? other_type : type;
            for (const auto &part : parts_of_cube(own))
            {
              std::vector<Index> corners;
              for (const unsigned int c : part)
                corners.push_back({{2 * i + cube[c][0], 2 * j + cube[c][1], 2 * k + cube[c][2]}});
              cells[own] << offset + ++n_cells;
              for (const Index &corner : corners)
                cells[own] << ", " << node(corner, at(corner));
              if (is_quadratic(own))
                for (const auto &edge : edges_of(own))
                {
                  const Index &a = corners[edge[0]], &b = corners[edge[1]],
                              middle = {{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}};
                  cells[own] << ", "
                             << node(middle, curved ? at(middle) : dealii::Point<3>((at(a) + at(b)) / 2));
                }
              cells[own] << "\n";
            }
          }
      std::ostringstream sets;
      const std::array<std::string, 6> names = {{"left", "right", "front", "back", "bottom", "top"}};
      for (unsigned int f = 0; f < 6; ++f)
      {
        sets << "*NSET, NSET=" << prefix << names[f] << "\n";
        for (const auto &[index, n] : number)
          if (index[f / 2] == (f % 2) * 2 * divisions[f / 2])
            sets << n << ",\n";
      }
      std::string elements;
      for (const auto &[own, lines] : cells)
        elements += "*ELEMENT, TYPE=" + own + ", ELSET=body\n" + lines.str();
      return "*NODE, NSET=" + prefix + "all\n" + nodes.str() + elements + sets.str() + more;
    }

    void write(const std::string &file) const { std::ofstream(file) << text(); }

  private:
    using Lists = std::vector<std::vector<unsigned int>>;

    static bool is_quadratic(const std::string &type) { return type.size() == 5; }
    static bool is_tetrahedra(const std::string &type) { return type == "C3D4" || type == "C3D10"; }
    static bool is_prisms(const std::string &type) { return type == "C3D6" || type == "C3D15"; }

    /// Tetrahedra share the diagonal 0-6 of the cube, prisms 0-2 and 4-6.
    static Lists parts_of_cube(const std::string &type)
    {
      return is_tetrahedra(type)
                 ? Lists{{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}
             : is_prisms(type) ? Lists{{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}
                               : Lists{{0, 1, 2, 3, 4, 5, 6, 7}};
    }

    static Lists edges_of(const std::string &type)
    {
      return is_tetrahedra(type) ? Lists{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}
             : is_prisms(type) ? Lists{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}
                               : Lists{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                       {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    }
  };
} // namespace vibrocontact

/// Half-space scenes of tests/data/README.md, shared by the contact tests.
#pragma once

#include <vibrocontact/contact/half_space.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace contact_cases
{
  using namespace vibrocontact;

  inline HalfSpacePair steel_pair()
  {
    return HalfSpacePair({206.9e9, 0.288}, {205e9, 0.3});
  }
  inline HalfSpacePair dissimilar_pair()
  {
    return HalfSpacePair({206.9e9, 0.288}, {20e9, 0.1});
  }

  /// gap of a cylinder of 460 mm on a crown of 300 mm
  inline ContactInterface wheel_on_crown(const ContactGrid &grid)
  {
    ContactInterface interface;
    interface.contacts.only() = grid;
    for (unsigned int i = 0; i < grid.n_points(); ++i)
      interface.gap.push_back(std::pow(grid.x(i), 2) / 0.92 + std::pow(grid.y(i), 2) / 0.6);
    return interface;
  }

  struct Case
  {
    HalfSpacePair pair = steel_pair();
    ContactParameters contact;
    RollingParameters rolling;
    ContactSolverParameters solver;

    Case()
    {
      contact.creep_scheme = "first-order upwind";
      rolling.normal_force = {66000};
    }
    ContactInterface interface() const { return wheel_on_crown(contact.grid()); }
    std::vector<RollingResult> run() const
    {
      return quasi_static_rolling(
          rolling, contact, solver, interface(),
          [&](const double speed)
          { return rolling_operator(contact.grid(), pair, find_creep_scheme(contact.creep_scheme), speed); },
          [](const RollingResult &, const ContactProblem &) {});
    }
  };

  /// columns of a CSV file by name
  inline std::map<std::string, std::vector<double>> read_table(const std::string &file_name)
  {
    std::ifstream file(file_name);
    std::string line, cell;
    std::getline(file, line);
    std::vector<std::string> names;
    std::istringstream header(line);
    while (std::getline(header, cell, ','))
      names.push_back(cell);
    std::map<std::string, std::vector<double>> table;
    while (std::getline(file, line))
    {
      std::istringstream row(line);
      for (const std::string &name : names)
      {
        std::getline(row, cell, ',');
        table[name].push_back(std::stod(cell));
      }
    }
    return table;
  }
} // namespace contact_cases

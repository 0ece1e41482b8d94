/// The stored contact problems of tests/contact_problems, for their tests and their benchmark.
#pragma once

#include "contact_cases.h"

#include <algorithm>

namespace stored_problems
{
  using namespace contact_cases;

  inline std::string folder()
  {
    return std::string(TESTS_DIRECTORY) + "/contact_problems/";
  }

  /// a line of half_space.csv by column
  using Description = std::map<std::string, std::string>;

  inline std::vector<Description> descriptions()
  {
    std::ifstream file(folder() + "half_space.csv");
    std::string line, cell;
    std::getline(file, line);
    std::vector<std::string> names;
    for (std::istringstream header(line); std::getline(header, cell, ',');)
      names.push_back(cell);
    std::vector<Description> all;
    while (std::getline(file, line))
    {
      std::istringstream row(line);
      all.emplace_back();
      for (const std::string &name : names)
        std::getline(row, all.back()[name], ',');
    }
    return all;
  }

  /// the problem of a line on its whole grid; creepages scaled by a factor
  inline ContactProblem build(const Description &d, const double creep_factor = 1)
  {
    const auto number = [&](const std::string &column) { return std::stod(d.at(column)); };
    ContactParameters contact;
    contact.spacing = number("spacing_mm") * 1e-3;
    contact.half_length = 10 * std::min(1e-3, 2 * contact.spacing);
    contact.half_width = 8 * std::min(1e-3, 2 * contact.spacing);
    contact.friction = number("mu");
    contact.normal_law = d.at("law");
    // a penetration of some micrometres under the mean force of a point
    contact.law_values.set("Penalty amplitude", 100);
    contact.law_values.set("Penalty exponent", 1e6);
    const CreepScheme &scheme = find_creep_scheme(d.at("scheme"));
    ContactInterface interface = wheel_on_crown(contact.grid());
    const ContactGrid &grid = interface.contacts.only();
    for (unsigned int i = 0; i < grid.n_points(); ++i)
      interface.gap[i] += number("waviness_um") * 1e-6 *
                          (2 - std::cos(2000 * grid.x(i)) - std::cos(2500 * grid.y(i) + 1000 * grid.x(i)));
    const HalfSpacePair pair = d.at("pair") == "steel"  ? steel_pair()
                               : d.at("pair") == "soft" ? dissimilar_pair()
                                                        : HalfSpacePair({1e3 * 206.9e9, 0.3}, {20e9, 0.});
    Creepage creepage;
    creepage.longitudinal = creep_factor * number("longitudinal");
    creepage.lateral = creep_factor * number("lateral");
    creepage.spin = creep_factor * number("spin_1_m");
    ContactProblem problem = rolling_problem(rolling_operator(grid, pair, scheme, creepage.speed), interface,
                                             scheme, creepage, contact);
    problem.title = d.at("name");
    problem.normal_force = number("force_N");
    return problem;
  }

  /// relative, in the Euclidean norm
  inline double difference(const DenseVector &a, const DenseVector &b)
  {
    DenseVector d = a;
    d -= b;
    return d.l2_norm() / b.l2_norm();
  }

  /// points in contact and those whose gap is not much above the approach
  inline std::vector<unsigned int> points_near_contact(const ContactProblem &whole, const ContactSolution &s)
  {
    std::vector<unsigned int> points;
    for (unsigned int i = 0; i < whole.n_points(); ++i)
      if (whole.b[i] < 1.25 * s.approach || s.status[i] != ContactStatus::open)
        points.push_back(i);
    return points;
  }
} // namespace stored_problems

#pragma once

#include <vibrocontact/contact/contact_solver.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  struct ContactSolverEntry
  {
    std::string name, help;
    std::unique_ptr<ContactSolver> (*create)(const ContactSolverParameters &);
  };

  /// fixed point, semi-smooth newton
  const std::vector<ContactSolverEntry> &contact_solvers();

  std::vector<std::string> contact_solver_names();

  /// @throws InputError naming the known methods
  std::unique_ptr<ContactSolver> create_contact_solver(const ContactSolverParameters &parameters);
} // namespace vibrocontact

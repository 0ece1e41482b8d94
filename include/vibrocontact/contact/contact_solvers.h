#pragma once

#include <vibrocontact/contact/contact_solver.h>

namespace vibrocontact
{
  /// @throws InputError naming the known methods
  std::unique_ptr<ContactSolver> create_contact_solver(const ContactSolverParameters &parameters);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/contact/contact_solver.h>

namespace vibrocontact
{
  /// Of the row that parameters name. A problem that the row does not take is refused when it is prepared or solved
  /// (InputError). @throws InputError naming the known methods
  std::unique_ptr<ContactSolver> create_contact_solver(const ContactSolverParameters &parameters);
} // namespace vibrocontact

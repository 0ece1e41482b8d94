#include <vibrocontact/base/named_table.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/fixed_point.h>
#include <vibrocontact/contact/newton.h>

namespace vibrocontact
{
  const std::vector<ContactSolverEntry> &contact_solvers()
  {
    static const std::vector<ContactSolverEntry> table = {
        {"semi-smooth newton", "Newton on the projections, active points only",
         [](const ContactSolverParameters &p) -> std::unique_ptr<ContactSolver>
         { return std::make_unique<NewtonSolver>(p); }},
        {"fixed point", "the paper's fixed point on the forces with constant rho",
         [](const ContactSolverParameters &p) -> std::unique_ptr<ContactSolver>
         { return std::make_unique<FixedPointSolver>(p); }}};
    return table;
  }

  std::vector<std::string> contact_solver_names()
  {
    return names_of(contact_solvers());
  }

  std::unique_ptr<ContactSolver> create_contact_solver(const ContactSolverParameters &parameters)
  {
    return find_named(contact_solvers(), parameters.method, "contact solver").create(parameters);
  }
} // namespace vibrocontact

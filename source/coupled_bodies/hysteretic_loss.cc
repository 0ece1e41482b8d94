#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/hysteretic_loss.h>

#include <algorithm>

namespace vibrocontact
{
  std::optional<double> loss_factor_of_rest(const BodyParameters &body)
  {
    if (body.materials.empty())
      return body.material_loss_factor();
    const double first = body.materials.begin()->second.loss_factor;
    for (const auto &group : body.materials)
      if (group.second.loss_factor != first)
        return {};
    return first;
  }

  namespace
  {
    /// Whether damping ratios stand for what elements lose, or for dampers and poles.
    bool loses_in_elements(const ContactBody &body)
    {
      return body.reduced ? body.parameters->is_meshed() && body.reduced->n_poles() == 0
                          : !body.parameters->description->is_rigid();
    }
  } // namespace

  HystereticLoss take_hysteretic_loss(ContactPair &pair, const std::vector<ContactBody> &bodies,
                                      const ContactSections &sections, const PlacedContacts &contacts)
  {
    if (!pair.relaxing.empty())
      throw InputError(
          "Stability/Loss is hysteretic, which stands in place of Modes/Stiffness damping: leave "
          "that out.");
    HystereticLoss loss;
    loss.modal.reinit(pair.n_modes(), pair.n_modes());
    loss.residual = entries_as<std::complex<double>>(pair.residual);
    unsigned int first = 0;
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const ContactBody &body = bodies[b];
      const unsigned int n_modes = body.reduced ? body.reduced->n_modes() : 0;
      if (loses_in_elements(body))
      {
        if (n_modes > 0 && body.reduced->loss.m() > 0)
          add_block(loss.modal, body.reduced->loss, first, first);
        else
          for (unsigned int k = first; k < first + n_modes; ++k)
            loss.modal(k, k) = 2 * pair.damping_ratio[k] * pair.omega[k] * pair.omega[k];
        std::fill_n(pair.damping_ratio.begin() + first, n_modes, 0.);
        const double eta = loss_factor_of_rest(*body.parameters).value_or(0);
        if (eta > 0)
        {
          const std::complex<double> change = 1. / std::complex<double>(1, eta) - 1.;
          loss.residual.add(
              change, entries_as<std::complex<double>>(brought_flexibility(bodies, b, sections, contacts)));
        }
      }
      first += n_modes;
    }
    return loss;
  }
} // namespace vibrocontact

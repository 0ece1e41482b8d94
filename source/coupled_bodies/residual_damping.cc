#include <vibrocontact/coupled_bodies/residual_damping.h>

#include <deal.II/base/numbers.h>

#include <complex>

namespace vibrocontact
{
  DroppedDamping dropped_residual_damping(const std::vector<LossyBody> &bodies, const double further,
                                          const std::vector<double> &frequencies)
  {
    using Complex = std::complex<double>;
    DroppedDamping worst;
    for (const double frequency : frequencies)
    {
      const double omega = 2 * dealii::numbers::PI * frequency;
      Complex receptance = further, change = 0;
      for (const LossyBody &lossy : bodies)
      {
        const ReducedBody &body = *lossy.body;
        const double W = body.residual(lossy.row, lossy.row),
                     loss = lossy.stiffness_damping * omega + lossy.loss_factor;
        const Complex taken = W / Complex(1, lossy.relaxation * omega);
        change += taken - W / Complex(1, loss);
        receptance += taken;
        for (unsigned int k = 0; k < body.omega.size(); ++k)
        {
          const double psi = body.trace(lossy.row, k), w = body.omega[k];
          receptance += psi * psi / Complex(w * w - omega * omega, 2 * body.damping_ratio[k] * w * omega);
        }
        for (unsigned int k = 0; k < body.n_poles(); ++k)
        {
          const Complex residue = body.right(lossy.row, k) * body.left(lossy.row, k);
          receptance += residue / (Complex(0, omega) - body.poles[k]) +
                        std::conj(residue) / (Complex(0, omega) - std::conj(body.poles[k]));
        }
      }
      if (const double share = std::abs(change / receptance); share > worst.change)
        worst = {share, frequency};
    }
    return worst;
  }
} // namespace vibrocontact

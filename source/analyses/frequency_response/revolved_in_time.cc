#include <vibrocontact/analyses/frequency_response/revolved_response.h>
#include <vibrocontact/reduction/damped_wheel.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/vector.hpp>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// Modes of n waves: frequencies and damping [rad/s, -], rows of the section by mode, loss between them.
    struct ModesOfWave
    {
      unsigned int n = 0;
      std::vector<double> omega, damping_ratio, rows, loss;

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &n &omega &damping_ratio &rows &loss;
      }
    };
  } // namespace

  std::vector<Receptance> RevolvedResponse::damped_in_time(const double highest,
                                                           const std::vector<double> &frequency)
  {
    const unsigned int m = points.size(), n_rows = rows.size();
    Receptance residual(m * m);
    std::vector<ModesOfWave> own;
    for (const Wave &wave : waves())
    {
      ModesOfWave modes;
      modes.n = wave.rotation.n_waves;
      const unsigned int n_kept = modes_below(wave.vectors, highest);
      for (unsigned int k = 0; k < n_kept; ++k)
      {
        modes.omega.push_back(wave.vectors.omega[k]);
        modes.damping_ratio.push_back(wave.vectors.damping_ratio[k]);
        for (unsigned int row = 0; row < n_rows; ++row)
          modes.rows.push_back(wave.vectors.trace(row, k));
        for (unsigned int l = 0; l < n_kept; ++l)
          modes.loss.push_back(wave.vectors.loss(l, k));
      }
      own.push_back(modes);
      for (const int sense : {-1, 1})
        add_wave(modes.n, sense, static_residual(wave.vectors, n_kept), residual);
    }
    dealii::Utilities::MPI::sum(residual, communicator, residual);
    std::vector<ModesOfWave> all;
    for (const std::vector<ModesOfWave> &some : dealii::Utilities::MPI::all_gather(communicator, own))
      all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end(), [](const ModesOfWave &a, const ModesOfWave &b) { return a.n < b.n; });

    // one after the other of each n and family; n = 0 has both in one
    ReducedBody body;
    std::vector<std::vector<double>> motions(m);
    std::vector<AttachedMass> masses;
    unsigned int n_all = 0;
    for (const ModesOfWave &modes : all)
      n_all += (modes.n == 0 ? 1 : 2) * modes.omega.size();
    body.loss.reinit(n_all, n_all);
    for (const ModesOfWave &modes : all)
      for (const bool odd : {false, true})
      {
        const unsigned int first = body.omega.size(), count = modes.omega.size();
        if (count == 0 || (odd && modes.n == 0))
          continue;
        body.omega.insert(body.omega.end(), modes.omega.begin(), modes.omega.end());
        body.damping_ratio.insert(body.damping_ratio.end(), modes.damping_ratio.begin(),
                                  modes.damping_ratio.end());
        for (unsigned int k = 0; k < count; ++k)
          for (unsigned int l = 0; l < count; ++l)
            body.loss(first + l, first + k) = modes.loss[k * count + l];
        for (unsigned int i = 0; i < m; ++i)
        {
          std::array<double, 3> weights = points[i].weights(modes.n, odd);
          for (unsigned int c = 0; c < 3 && modes.n == 0; ++c)
            weights[c] += points[i].weights(0, true)[c];
          for (unsigned int k = 0; k < count; ++k)
          {
            double sum = 0;
            for (unsigned int c = 0; c < 3; ++c)
              if (points[i].has(c))
                sum += weights[c] * modes.rows[k * n_rows + row_of[i][c]];
            motions[i].push_back(sum);
          }
        }
        for (const Attachment &ring : dampers.rings)
        {
          AttachedMass mass{ring, "", {}};
          if (modes.n > 0)
            mass.mass /= 2;
          mass.motion.assign(n_all, 0.);
          for (unsigned int k = 0; k < count; ++k)
            mass.motion[first + k] = modes.rows[k * n_rows + ring.row];
          masses.push_back(mass);
        }
      }
    body.labels.resize(n_all);
    body.participation.reinit(n_all, 3);
    body.trace.reinit(n_asked, n_all);
    for (unsigned int i = 0; i < n_asked; ++i)
      for (unsigned int k = 0; k < n_all; ++k)
        body.trace(i, k) = motions[i][k];
    for (const Attachment &absorber : dampers.absorbers)
    {
      masses.push_back({absorber, "", motions[n_asked + absorber.row]});
    }
    body = with_attached(std::move(body), masses);

    ResponseReduction damped;
    damped.omega = body.omega;
    damped.damping_ratio = body.damping_ratio;
    damped.trace = body.trace;
    damped.compliance.reinit(n_asked, n_asked);
    add_modal_compliance(damped.compliance, body.trace, body.omega, "the wheel");
    for (unsigned int i = 0; i < n_asked; ++i)
      for (unsigned int j = 0; j < n_asked; ++j)
        damped.compliance(i, j) += residual[i * m + j].real();
    return time_domain_response(damped, body.omega.size(), frequency);
  }
} // namespace vibrocontact

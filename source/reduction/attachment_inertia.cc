#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/attachment_inertia.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  DenseMatrix attachment_mass(const SecondOrderSystem &system, Flexibility &flexibility)
  {
    const unsigned int n = system.trace.rows.size();
    DenseMatrix mass(n);
    dealii::PETScWrappers::MPI::Vector force(system.locally_owned, system.communicator), response(force),
        inertia(force);
    Progress progress(system.body + ": inertia of " + std::to_string(n) + " attachment responses", n);
    for (unsigned int column = 0; column < n; ++column)
    {
      progress.advance();
      if (system.trace.rows[column].empty())
        continue;
      force = 0;
      for (const auto &[dof, weight] : system.trace.rows[column])
        if (system.locally_owned.is_element(dof))
          force(dof) = weight;
      force.compress(dealii::VectorOperation::insert);
      flexibility.vmult(response, force);
      system.mass.vmult(inertia, response);
      flexibility.vmult(response, inertia);
      const std::vector<double> rows = contact_trace(system.trace, response);
      std::copy(rows.begin(), rows.end(), &mass(0, column));
    }
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < j; ++i)
        mass(i, j) = mass(j, i) = (mass(i, j) + mass(j, i)) / 2;
    return mass;
  }

  namespace
  {
    struct Spectrum
    {
      std::vector<double> values;
      std::vector<dealii::Vector<double>> vectors;
    };

    // of a symmetric matrix, ascending
    Spectrum spectrum(DenseMatrix matrix)
    {
      const unsigned int n = matrix.m();
      matrix.set_property(dealii::LAPACKSupport::symmetric);
      dealii::FullMatrix<double> vectors;
      dealii::Vector<double> values;
      const double bound = 2 * matrix.linfty_norm() + 1e-300;
      matrix.compute_eigenvalues_symmetric(-bound, bound, 0., values, vectors);
      AssertThrow(values.size() == n, dealii::ExcMessage("not all eigenvalues of a symmetric matrix found"));
      Spectrum result;
      for (unsigned int k = 0; k < n; ++k)
      {
        result.values.push_back(values[k]);
        result.vectors.emplace_back(n);
        for (unsigned int i = 0; i < n; ++i)
          result.vectors.back()[i] = vectors(i, k);
      }
      return result;
    }
  } // namespace

  ReducedBody with_attachment_inertia(ReducedBody body, const DenseMatrix &mass)
  {
    const DenseMatrix &W = body.residual;
    const unsigned int n = W.m(), m = body.omega.size(), first = body.n_rigid_modes;
    DenseMatrix M = mass;
    double largest = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      double diagonal = W(i, i);
      for (unsigned int k = first; k < m; ++k)
        diagonal += std::pow(body.trace(i, k) / body.omega[k], 2);
      largest = std::max(largest, diagonal);
    }
    for (unsigned int k = first; k < m; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          M(i, j) -= body.trace(i, k) * body.trace(j, k) / std::pow(body.omega[k], 4);

    // W~ = V L V^T on its range; then L^-1/2 V^T M_r V L^-1/2 z = nu^-2 z and W~ X = V L^1/2 z nu
    const Spectrum flexible = spectrum(W);
    std::vector<unsigned int> kept;
    for (unsigned int k = 0; k < n; ++k)
      if (flexible.values[k] > 1e-10 * largest)
        kept.push_back(k);
    const unsigned int r = kept.size();
    DenseMatrix V(n, r), MV(n, r), inverse_squares(r);
    for (unsigned int k = 0; k < r; ++k)
      for (unsigned int i = 0; i < n; ++i)
        V(i, k) = flexible.vectors[kept[k]][i] / std::sqrt(flexible.values[kept[k]]);
    if (r > 0)
    {
      M.mmult(MV, V);
      V.Tmmult(inverse_squares, MV);
    }
    for (unsigned int j = 0; j < r; ++j)
      for (unsigned int i = 0; i < j; ++i)
        inverse_squares(i, j) = inverse_squares(j, i) = (inverse_squares(i, j) + inverse_squares(j, i)) / 2;
    const Spectrum residual = r > 0 ? spectrum(inverse_squares) : Spectrum();

    DenseMatrix trace(n, m + r), participation(m + r, 3);
    for (unsigned int k = 0; k < m; ++k)
    {
      for (unsigned int i = 0; i < n; ++i)
        trace(i, k) = body.trace(i, k);
      for (unsigned int d = 0; d < 3 && body.participation.m() > 0; ++d)
        participation(k, d) = body.participation(k, d);
    }
    for (unsigned int k = 0; k < r; ++k)
    {
      // ascending frequencies
      const unsigned int j = r - 1 - k;
      if (!(residual.values[j] > 0))
        throw ConvergenceError(
            "The inertia of the attachment responses of body '" + body.name +
            "' is not positive: its mesh has badly shaped cells, or so many modes are kept "
            "that nothing is left; keep fewer.");
      const double nu = 1 / std::sqrt(residual.values[j]);
      double load = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        double x = 0;
        for (unsigned int l = 0; l < r; ++l)
        {
          trace(i, m + k) += V(i, l) * flexible.values[kept[l]] * residual.vectors[j][l] * nu;
          x += V(i, l) * residual.vectors[j][l] * nu;
        }
        load += x * body.residual_load[i];
      }
      body.omega.push_back(nu);
      body.damping_ratio.push_back(m > 0 ? body.damping_ratio[m - 1] : 0.);
      body.labels.push_back(residual_label + std::to_string(k + 1));
      body.modal_load.push_back(load);
    }
    body.trace = trace;
    body.participation = participation;
    body.residual.reinit(n);
    body.loss = DenseMatrix();
    std::fill(body.residual_load.begin(), body.residual_load.end(), 0.);
    return body;
  }
} // namespace vibrocontact

#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/damped_wheel.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// entries of a loss below this share of the diagonal's couple nothing
    constexpr double least_coupling_of_loss = 1e-6;

    bool couples_modes(const DenseMatrix &loss)
    {
      for (unsigned int j = 0; j < loss.n(); ++j)
        for (unsigned int i = 0; i < j; ++i)
          if (std::abs(loss(i, j)) > least_coupling_of_loss * std::sqrt(std::abs(loss(i, i) * loss(j, j))))
            return true;
      return false;
    }

    /// H of a body, also if only its diagonal is kept.
    DenseMatrix full_loss(const ReducedBody &body)
    {
      if (body.loss.m() > 0)
        return body.loss;
      const unsigned int n = body.n_modes();
      DenseMatrix result(n, n);
      for (unsigned int k = 0; k < n; ++k)
        result(k, k) = 2 * body.damping_ratio[k] * body.omega[k] * body.omega[k];
      return result;
    }

    /// Each vector's name: of the coordinate that has most of its kinetic energy, each name once.
    std::vector<std::string> names_by_likeness(const DenseMatrix &vectors, const DenseMatrix &mass,
                                               const std::vector<std::string> &names)
    {
      struct Likeness
      {
        double value;
        unsigned int coordinate, vector;
      };
      const unsigned int n = names.size();
      std::vector<Likeness> all;
      for (unsigned int e = 0; e < n; ++e)
        for (unsigned int i = 0; i < n; ++i)
          all.push_back({vectors(i, e) * vectors(i, e) * mass(i, i), i, e});
      std::stable_sort(all.begin(), all.end(),
                       [](const Likeness &a, const Likeness &b) { return a.value > b.value; });
      std::vector<bool> taken(n, false), placed(n, false);
      std::vector<std::string> result(n);
      for (const Likeness &one : all)
        if (!taken[one.coordinate] && !placed[one.vector])
        {
          taken[one.coordinate] = placed[one.vector] = true;
          result[one.vector] = names[one.coordinate];
        }
      return result;
    }
  } // namespace

  void add_loss(ReducedBody &body, const DenseMatrix &added)
  {
    const DenseMatrix before = full_loss(body);
    const bool coupled = body.loss.m() > 0 || couples_modes(added);
    for (unsigned int k = 0; k < body.n_modes(); ++k)
      body.damping_ratio[k] += added(k, k) / (2 * body.omega[k] * body.omega[k]);
    if (!coupled)
      return;
    body.loss = before;
    body.loss.add(1., added);
  }

  ReducedBody with_attached(ReducedBody body, const std::vector<AttachedMass> &masses)
  {
    std::vector<const AttachedMass *> sprung;
    for (const AttachedMass &one : masses)
      if (one.is_sprung())
        sprung.push_back(&one);
    if (masses.empty())
      return body;
    const unsigned int n = body.n_modes(), size = n + sprung.size(), n_rows = body.trace.m();
    DenseMatrix M(size, size), K(size, size), H(size, size);
    add_block(H, full_loss(body), 0, 0);
    std::vector<std::string> names = body.labels;
    for (unsigned int k = 0; k < n; ++k)
    {
      M(k, k) = 1;
      K(k, k) = body.omega[k] * body.omega[k];
    }
    const unsigned int n_motions = body.participation.n() == 6 ? 6 : 3;
    DenseMatrix participation(size, n_motions);
    add_block(participation, body.participation, 0, 0);
    for (const AttachedMass &one : masses)
      for (unsigned int l = 0; l < n && !one.is_sprung(); ++l)
      {
        for (unsigned int k = 0; k < n; ++k)
          M(k, l) += one.mass * one.motion[k] * one.motion[l];
        for (unsigned int d = 0; d < n_motions; ++d)
          participation(l, d) += one.mass * one.motion[l] * one.along[d];
      }
    for (unsigned int a = 0; a < sprung.size(); ++a)
    {
      const AttachedMass &one = *sprung[a];
      std::vector<double> stretch(size, 0.);
      std::copy(one.motion.begin(), one.motion.end(), stretch.begin());
      stretch[n + a] = -1;
      const double k = one.stiffness();
      for (unsigned int j = 0; j < size; ++j)
        for (unsigned int i = 0; i < size; ++i)
        {
          K(i, j) += k * stretch[i] * stretch[j];
          H(i, j) += one.loss_factor * k * stretch[i] * stretch[j];
        }
      M(n + a, n + a) = one.mass;
      for (unsigned int d = 0; d < n_motions; ++d)
        participation(n + a, d) = one.mass * one.along[d];
      names.push_back(one.label);
    }
    for (const AttachedMass &one : masses)
      for (unsigned int c = 0; c < 6 && body.hub; ++c)
        for (unsigned int d = 0; d < 6; ++d)
          body.hub->mass(c, d) += one.mass * one.along[c] * one.along[d];
    const DenseMatrix mass = M;
    std::vector<DenseVector> vectors(size, DenseVector(size));
    try
    {
      K.compute_generalized_eigenvalues_symmetric(M, vectors);
    }
    catch (const dealii::ExceptionBase &)
    {
      throw ConvergenceError("LAPACK found no modes of " + body.name + " with its dampers.");
    }
    DenseMatrix X(size, size), own(n_rows, size);
    body.omega.resize(size);
    for (unsigned int e = 0; e < size; ++e)
    {
      body.omega[e] = std::sqrt(std::max(0., K.eigenvalue(e).real()));
      std::copy(vectors[e].begin(), vectors[e].end(), &X(0, e));
    }
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < n_rows; ++i)
        own(i, k) = body.trace(i, k);
    body.trace = product(own, X);
    const std::vector<double> load = body.modal_load;
    body.modal_load.assign(load.empty() ? 0 : size, 0.);
    for (unsigned int e = 0; e < body.modal_load.size(); ++e)
      for (unsigned int k = 0; k < n; ++k)
        body.modal_load[e] += X(k, e) * load[k];
    body.participation.reinit(size, n_motions);
    X.Tmmult(body.participation, participation);
    body.loss.reinit(size, size);
    X.Tmmult(body.loss, product(H, X));
    body.damping_ratio.resize(size);
    for (unsigned int e = 0; e < size; ++e)
      body.damping_ratio[e] = body.loss(e, e) / (2 * body.omega[e] * body.omega[e]);
    body.mixing.reinit(n, size);
    for (unsigned int e = 0; e < size; ++e)
      for (unsigned int k = 0; k < n; ++k)
        body.mixing(k, e) = X(k, e);
    body.labels = names_by_likeness(X, mass, names);
    return body;
  }
} // namespace vibrocontact

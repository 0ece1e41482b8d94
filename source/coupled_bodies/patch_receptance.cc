#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/patch_shapes.h>
#include <vibrocontact/coupled_bodies/patch_receptance.h>
#include <vibrocontact/numerics/complex_eigenvectors.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// F has to see what the eigenvalues see
    constexpr double shape_tolerance = 1e-11;

    /// left (diag(inertia s^2 + damping s + stiffness) + s into stretch)^-1 right; poles have no inertia, damping 1 and stiffness
    /// -lambda
    struct ModalSum
    {
      ComplexMatrix left, right;
      /// of dampers between the modes; empty: there are none
      ComplexMatrix into = ComplexMatrix(), stretch = ComplexMatrix();
      std::vector<Complex> stiffness;
      std::vector<double> damping;
      double inertia = 1;

      /// sum of weights of its terms; n_shapes square
      ComplexMatrix weighted(const std::function<Complex(unsigned int)> &weight) const
      {
        ComplexMatrix scaled = left;
        for (unsigned int k = 0; k < scaled.n(); ++k)
        {
          const Complex factor = weight(k);
          for (unsigned int i = 0; i < scaled.m(); ++i)
            scaled(i, k) *= factor;
        }
        return product(scaled, right);
      }
      Complex denominator(const unsigned int k, const Complex &s) const
      {
        return inertia * s * s + damping[k] * s + stiffness[k];
      }
      bool has_dampers() const { return into.n() > 0; }
      /// (D + s P Q)^-1 v with the diagonal D, by the small matrix 1 + s Q D^-1 P (Woodbury)
      ComplexMatrix solved(const Complex &s, const ComplexMatrix &P, const ComplexMatrix &Q,
                           ComplexMatrix v) const
      {
        const auto divide = [&](ComplexMatrix &by_modes)
        {
          for (unsigned int j = 0; j < by_modes.n(); ++j)
            for (unsigned int k = 0; k < by_modes.m(); ++k)
              by_modes(k, j) /= denominator(k, s);
        };
        ComplexMatrix taken = P;
        divide(taken);
        divide(v);
        // LAPACK scales by real numbers alone
        ComplexMatrix small(Q.m(), Q.m()), forces = product(Q, v);
        small.add(s, product(Q, taken));
        for (unsigned int d = 0; d < small.m(); ++d)
          small(d, d) += 1.;
        small.compute_lu_factorization();
        small.solve(forces);
        v.add(-s, product(taken, forces));
        return v;
      }
      ComplexMatrix value(const Complex &s) const
      {
        if (has_dampers())
          return product(left, solved(s, into, stretch, right));
        return weighted([&](const unsigned int k) { return 1. / denominator(k, s); });
      }
      Complex slope(const unsigned int k, const Complex &s) const
      {
        const Complex d = denominator(k, s);
        return -(2. * inertia * s + damping[k]) / (d * d);
      }
      ComplexMatrix derivative(const Complex &s) const
      {
        if (has_dampers())
        {
          const ComplexMatrix from_left =
              transposed(solved(s, transposed(stretch), transposed(into), transposed(left)));
          ComplexMatrix moved = solved(s, into, stretch, right),
                        slope = product(into, product(stretch, moved));
          for (unsigned int j = 0; j < moved.n(); ++j)
            for (unsigned int k = 0; k < moved.m(); ++k)
              slope(k, j) += (2. * inertia * s + damping[k]) * moved(k, j);
          ComplexMatrix result(from_left.m(), slope.n());
          result.add(-1., product(from_left, slope));
          return result;
        }
        return weighted([&](const unsigned int k) { return slope(k, s); });
      }
      ComplexVector times(const Complex &s, const ComplexVector &v) const
      {
        if (has_dampers())
          return product(value(s), v);
        ComplexVector q = product(right, v);
        for (unsigned int k = 0; k < q.size(); ++k)
          q[k] /= denominator(k, s);
        return product(left, q);
      }
      ComplexVector derivative_times(const Complex &s, const ComplexVector &v) const
      {
        if (has_dampers())
          return product(derivative(s), v);
        ComplexVector q = product(right, v);
        for (unsigned int k = 0; k < q.size(); ++k)
          q[k] *= slope(k, s);
        return product(left, q);
      }
    };

    /// Goes over to the eigenvectors of diag(w^2) + j H.
    void diagonalise(const DenseMatrix &H, ModalSum &modes)
    {
      const unsigned int m = modes.stiffness.size();
      ComplexMatrix K(m, m);
      for (unsigned int j = 0; j < m; ++j)
      {
        if (modes.damping[j] != 0)
          throw InputError("A body with several loss factors has modes with viscous damping as well, which "
                           "the contact's receptance does not take together.");
        for (unsigned int i = 0; i < m; ++i)
          K(i, j) = Complex(0, H(i, j));
        K(j, j) += modes.stiffness[j];
      }
      const ComplexEigenvectors own = complex_eigenvectors(K, "eigenvalues of the modes with loss");
      modes.left = product(modes.left, own.right);
      modes.right = product(own.left, modes.right);
      if (modes.has_dampers())
      {
        modes.into = product(own.left, modes.into);
        modes.stretch = product(modes.stretch, own.right);
      }
      modes.stiffness = own.values;
    }

    PatchReceptance of_sum(ModalSum &&terms, DenseMatrix &&basis)
    {
      const auto sum = std::make_shared<const ModalSum>(std::move(terms));
      return {std::move(basis), [sum](const Complex &s) { return sum->value(s); },
              [sum](const Complex &s) { return sum->derivative(s); },
              [sum](const Complex &s, const ComplexVector &v) { return sum->times(s, v); },
              [sum](const Complex &s, const ComplexVector &v) { return sum->derivative_times(s, v); }};
    }

    bool is_diagonal(const DenseMatrix &matrix)
    {
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int i = 0; i < matrix.m(); ++i)
          if (i != j && matrix(i, j) != 0)
            return false;
      return true;
    }
  } // namespace

  PatchReceptance modal_receptance(const ContactPair &pair, const unsigned int b, const HystereticLoss *loss)
  {
    std::vector<unsigned int> own;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      if (pair.body[k] == b)
        own.push_back(k);
    const unsigned int m = own.size();
    DenseMatrix trace(pair.trace.m(), m), H(m, m);
    ModalSum modes;
    for (unsigned int j = 0; j < m; ++j)
    {
      const double w = pair.omega[own[j]];
      modes.stiffness.emplace_back(w * w);
      modes.damping.push_back(2 * pair.damping_ratio[own[j]] * w);
      for (unsigned int i = 0; i < trace.m(); ++i)
        trace(i, j) = pair.trace(i, own[j]);
      for (unsigned int i = 0; i < m && loss; ++i)
        H(i, j) = loss->modal(own[i], own[j]);
    }
    PatchShapes shapes = patch_shapes(trace, shape_tolerance);
    modes.left = entries_as<Complex>(shapes.amplitudes);
    modes.right = transposed(modes.left);
    if (b == 1 && pair.hub && pair.hub->is_damped())
    {
      // modes of body 1 come first
      modes.stretch = entries_as<Complex>(pair.hub->dampers);
      modes.into = transposed(modes.stretch);
      for (unsigned int d = 0; d < modes.into.n(); ++d)
        for (unsigned int k = 0; k < m; ++k)
          modes.into(k, d) *= pair.hub->damping[d];
    }
    if (!is_diagonal(H))
      diagonalise(H, modes);
    else
      for (unsigned int k = 0; k < m; ++k)
        modes.stiffness[k] += Complex(0, H(k, k));
    return of_sum(std::move(modes), std::move(shapes.basis));
  }

  namespace
  {
    /// Real and imaginary parts of the poles' shapes, then those of the gradient below them in units of the shapes.
    DenseMatrix parts_of_poles(const ContactPair &pair, const std::vector<unsigned int> &own,
                               const ComplexMatrix &shapes, const ComplexMatrix *const gradient,
                               const double length)
    {
      const unsigned int n = 3 * pair.n_points(), p = own.size();
      DenseMatrix parts(gradient ? 2 * n : n, 2 * p);
      for (unsigned int k = 0; k < p; ++k)
        for (unsigned int i = 0; i < n; ++i)
        {
          parts(i, k) = shapes(i, own[k]).real();
          parts(i, p + k) = shapes(i, own[k]).imag();
          if (!gradient)
            continue;
          parts(n + i, k) = length * (*gradient)(i, own[k]).real();
          parts(n + i, p + k) = length * (*gradient)(i, own[k]).imag();
        }
      return parts;
    }

    /// Complex amplitudes of the poles and of their conjugates; rank x 2 p
    ComplexMatrix amplitudes_of_poles(const DenseMatrix &parts)
    {
      const unsigned int p = parts.n() / 2;
      ComplexMatrix result(parts.m(), 2 * p);
      for (unsigned int k = 0; k < p; ++k)
        for (unsigned int r = 0; r < parts.m(); ++r)
        {
          result(r, k) = Complex(parts(r, k), parts(r, p + k));
          result(r, p + k) = std::conj(result(r, k));
        }
      return result;
    }

    DenseMatrix rows_from(const DenseMatrix &matrix, const unsigned int first, const unsigned int n,
                          const double factor)
    {
      DenseMatrix result(n, matrix.n());
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int i = 0; i < n; ++i)
          result(i, j) = factor * matrix(first + i, j);
      return result;
    }
  } // namespace

  PatchReceptance pole_receptance(const ContactPair &pair, const unsigned int b)
  {
    const unsigned int n = 3 * pair.n_points();
    std::vector<unsigned int> own;
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
      if (pair.body_of_pole[k] == b)
        own.push_back(k);
    if (own.empty())
      return PatchReceptance();
    const bool flows = pair.gradient.m() > 0;
    // over which shapes change, so that the shapes of both are equally true
    const double length =
        pair.interface.contacts.all.front().grid.spacing_x * pair.interface.contacts.all.front().grid.n_x;
    const PatchShapes moved = patch_shapes(
        parts_of_poles(pair, own, pair.right, flows ? &pair.gradient : nullptr, length), shape_tolerance);
    PatchShapes driven = patch_shapes(parts_of_poles(pair, own, pair.left, nullptr, length), shape_tolerance);
    ModalSum poles;
    poles.inertia = 0;
    poles.damping.assign(2 * own.size(), 1.);
    for (const bool conjugate : {false, true})
      for (const unsigned int k : own)
        poles.stiffness.push_back(-(conjugate ? std::conj(pair.poles[k]) : pair.poles[k]));
    poles.left = amplitudes_of_poles(moved.amplitudes);
    poles.right = transposed(amplitudes_of_poles(driven.amplitudes));
    PatchReceptance result = of_sum(std::move(poles), rows_from(moved.basis, 0, n, 1));
    result.forces = std::move(driven.basis);
    if (flows)
      result.gradient = rows_from(moved.basis, n, n, 1 / length);
    return result;
  }

  std::vector<PatchReceptance> patch_receptances(const ContactPair &pair, const HystereticLoss *loss)
  {
    std::vector<PatchReceptance> result;
    unsigned int n_bodies = 0;
    for (const std::vector<unsigned int> *const bodies : {&pair.body, &pair.body_of_pole})
      for (const unsigned int b : *bodies)
        n_bodies = std::max(n_bodies, b);
    for (unsigned int b = 1; b <= n_bodies; ++b)
    {
      const bool is_exact = loss && std::any_of(loss->exact.begin(), loss->exact.end(),
                                                [&](const ExactReceptance &one) { return one.body == b; });
      result.push_back(modal_receptance(pair, b, loss));
      if (!is_exact && std::count(pair.body_of_pole.begin(), pair.body_of_pole.end(), b) > 0)
        result.push_back(pole_receptance(pair, b));
    }
    return result;
  }

  std::vector<PatchReceptance> all_patch_receptances(const ContactPair &pair, const HystereticLoss *loss)
  {
    std::vector<PatchReceptance> result = patch_receptances(pair, loss);
    for (unsigned int k = 0; loss && k < loss->exact.size(); ++k)
    {
      const ExactReceptance &body = loss->exact[k];
      result.push_back({body.basis, body.nearby, body.nearby_derivative});
    }
    return result;
  }
} // namespace vibrocontact

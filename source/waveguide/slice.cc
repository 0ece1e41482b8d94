#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/waveguide/slice.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;
  using Complex = std::complex<double>;

  namespace
  {
    ComplexMatrix block(const ComplexMatrix &matrix, const unsigned int row, const unsigned int column,
                        const unsigned int n_rows, const unsigned int n_columns)
    {
      ComplexMatrix result(n_rows, n_columns);
      for (unsigned int j = 0; j < n_columns; ++j)
        for (unsigned int i = 0; i < n_rows; ++i)
          result(i, j) = matrix(row + i, column + j);
      return result;
    }

    void add(ComplexMatrix &into, const ComplexMatrix &matrix, const unsigned int row,
             const unsigned int column, const Complex factor)
    {
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int i = 0; i < matrix.m(); ++i)
          into(row + i, column + j) += factor * matrix(i, j);
    }

    /// Eliminates the middle dofs of a symmetric system from all others: those of the ends and loads, stacked as [ends;
    /// loads] with D = [S -F; F^T C]: with A x = B y in the middle, the others gain -+ B^T A^-1 B.
    /// @param A middle, overwritten @param ends coupling, middle x ends @param loads forces on the middle, middle x loads
    void condense(ComplexMatrix &A, const ComplexMatrix &ends, const ComplexMatrix &loads, Slice &slice)
    {
      const unsigned int n_loads = loads.n(), n_ends = ends.n();
      ComplexMatrix both(A.m(), n_ends + n_loads);
      add(both, ends, 0, 0, 1.);
      if (n_loads > 0)
        add(both, loads, 0, n_ends, 1.);
      const ComplexMatrix right = both;
      A.compute_lu_factorization();
      A.solve(both);
      ComplexMatrix products(n_ends + n_loads, n_ends + n_loads);
      right.Tmmult(products, both);
      // middle: A x + ends q = loads c
      for (unsigned int j = 0; j < n_ends; ++j)
        for (unsigned int i = 0; i < n_ends; ++i)
          slice.stiffness(i, j) -= products(i, j);
      for (unsigned int j = 0; j < n_loads; ++j)
      {
        for (unsigned int i = 0; i < n_ends; ++i)
          slice.forces(i, j) -= products(i, n_ends + j);
        for (unsigned int i = 0; i < n_loads; ++i)
          slice.compliance(i, j) += products(n_ends + i, n_ends + j);
      }
    }

    Slice empty_slice(const unsigned int m, const unsigned int n_loads)
    {
      Slice slice;
      slice.stiffness.reinit(2 * m, 2 * m);
      slice.forces.reinit(2 * m, n_loads);
      slice.compliance.reinit(n_loads, n_loads);
      return slice;
    }
  } // namespace

  SectionAtFrequency::SectionAtFrequency(const SectionMatrices &section, const Complex omega,
                                         const ComplexMatrix &springs)
      : K0(section.n_shapes(), section.n_shapes()), K1(K0), K2(K0)
  {
    ComplexMatrix *const sums[3] = {&K0, &K1, &K2};
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int c = 0; c < n_shapes(); ++c)
        for (unsigned int r = 0; r < n_shapes(); ++r)
          (*sums[j])(r, c) = Complex(section.stiffness[j](r, c), section.loss_stiffness[j](r, c));
    for (unsigned int c = 0; c < n_shapes(); ++c)
      for (unsigned int r = 0; r < n_shapes(); ++r)
        K0(r, c) -= omega * omega * section.mass(r, c);
    if (springs.m() > 0)
      add(K0, springs, 0, 0, 1.);
  }

  Slice element_slice(const SectionAtFrequency &section, const double from, const double length,
                      const unsigned int degree, const std::vector<AxialLoad> &loads)
  {
    const unsigned int m = section.n_shapes(), n_nodes = degree + 1, n_loads = loads.size();
    const FE_Q<1> polynomials(degree);
    const QGauss<1> gauss(degree + 1);
    // int L_a L_b, L_a L_b', L_a' L_b' dx
    FullMatrix<double> I00(n_nodes, n_nodes), I01(I00), I11(I00);
    std::vector<double> moment0(n_nodes), moment1(n_nodes);
    for (unsigned int q = 0; q < gauss.size(); ++q)
      for (unsigned int a = 0; a < n_nodes; ++a)
      {
        const double weight = length * gauss.weight(q), La = polynomials.shape_value(a, gauss.point(q)),
                     Da = polynomials.shape_grad(a, gauss.point(q))[0] / length;
        moment0[a] += weight * La;
        moment1[a] += weight * La * (from + length * gauss.point(q)[0]);
        for (unsigned int b = 0; b < n_nodes; ++b)
        {
          const double Lb = polynomials.shape_value(b, gauss.point(q)),
                       Db = polynomials.shape_grad(b, gauss.point(q))[0] / length;
          I00(a, b) += weight * La * Lb;
          I01(a, b) += weight * La * Db;
          I11(a, b) += weight * Da * Db;
        }
      }
    // deal.II numbers the two ends first
    const auto element = [&](const unsigned int first_a, const unsigned int n_a, const unsigned int first_b,
                             const unsigned int n_b)
    {
      ComplexMatrix result(n_a * m, n_b * m);
      for (unsigned int b = 0; b < n_b; ++b)
        for (unsigned int c = 0; c < m; ++c)
          for (unsigned int a = 0; a < n_a; ++a)
            for (unsigned int r = 0; r < m; ++r)
              result(a * m + r, b * m + c) = I00(first_a + a, first_b + b) * section.K0(r, c) +
                                             I01(first_a + a, first_b + b) * section.K1(r, c) +
                                             I01(first_b + b, first_a + a) * section.K1(c, r) +
                                             I11(first_a + a, first_b + b) * section.K2(r, c);
      return result;
    };
    const auto on_nodes = [&](const unsigned int first, const unsigned int n)
    {
      ComplexMatrix result(n * m, n_loads);
      const double slack = 1e-9 * length;
      for (unsigned int j = 0; j < n_loads; ++j)
        if (loads[j].length > 0 &&
            std::abs(from + length / 2 - loads[j].centre) <= (loads[j].length - length) / 2 + slack)
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int r = 0; r < m; ++r)
              result(a * m + r, j) =
                  moment0[first + a] * loads[j].constant(r) +
                  (moment1[first + a] - loads[j].centre * moment0[first + a]) * loads[j].linear(r);
      return result;
    };
    Slice slice = empty_slice(m, n_loads);
    slice.stiffness = element(0, 2, 0, 2);
    if (n_loads > 0)
      slice.forces = on_nodes(0, 2);
    ComplexMatrix middle = element(2, degree - 1, 2, degree - 1);
    condense(middle, element(2, degree - 1, 0, 2), on_nodes(2, degree - 1), slice);
    return slice;
  }

  Slice join(const Slice &left, const Slice &right)
  {
    const unsigned int m = left.n_shapes(), n_loads = left.n_loads();
    Slice slice = empty_slice(m, n_loads);
    ComplexMatrix middle = block(left.stiffness, m, m, m, m), ends(m, 2 * m), loads(m, n_loads);
    add(middle, block(right.stiffness, 0, 0, m, m), 0, 0, 1.);
    add(ends, block(left.stiffness, m, 0, m, m), 0, 0, 1.);
    add(ends, block(right.stiffness, 0, m, m, m), 0, m, 1.);
    add(slice.stiffness, block(left.stiffness, 0, 0, m, m), 0, 0, 1.);
    add(slice.stiffness, block(right.stiffness, m, m, m, m), m, m, 1.);
    if (n_loads > 0)
    {
      add(loads, block(left.forces, m, 0, m, n_loads), 0, 0, 1.);
      add(loads, block(right.forces, 0, 0, m, n_loads), 0, 0, 1.);
      add(slice.forces, block(left.forces, 0, 0, m, n_loads), 0, 0, 1.);
      add(slice.forces, block(right.forces, m, 0, m, n_loads), m, 0, 1.);
      add(slice.compliance, left.compliance, 0, 0, 1.);
      add(slice.compliance, right.compliance, 0, 0, 1.);
    }
    condense(middle, ends, loads, slice);
    return slice;
  }

  Slice uniform_slice(const SectionAtFrequency &section, const double length, const double one_element,
                      const unsigned int degree)
  {
    const unsigned int doublings = std::max(0., std::ceil(std::log2(length / one_element) - 1e-9));
    Slice slice = element_slice(section, 0, length / (1u << doublings), degree, {});
    for (unsigned int k = 0; k < doublings; ++k)
      slice = join(slice, slice);
    return slice;
  }

  Slice with_loads(Slice slice, const unsigned int n_loads)
  {
    slice.forces.reinit(2 * slice.n_shapes(), n_loads);
    slice.compliance.reinit(n_loads, n_loads);
    return slice;
  }

  void add_section_load(Slice &slice, const unsigned int load, const DenseVector &force)
  {
    for (unsigned int r = 0; r < force.size(); ++r)
      slice.forces(slice.n_shapes() + r, load) += force(r);
  }

  InfiniteEnds infinite_ends(const Slice &span)
  {
    const unsigned int m = span.n_shapes(), most_doublings = 40;
    Slice slice = span;
    slice.forces.reinit(2 * m, 0);
    slice.compliance.reinit(0, 0);
    for (unsigned int k = 0; k < most_doublings; ++k)
    {
      // each motion by its own stiffness: a slab may be stiffer by far than the rail on it
      bool any_across = false;
      for (unsigned int c = 0; c < m; ++c)
        for (unsigned int r = 0; r < m; ++r)
          // what is no number has not decayed
          any_across = any_across ||
                       !(std::norm(slice.stiffness(r, m + c)) <=
                         1e-28 * std::abs(slice.stiffness(r, r)) * std::abs(slice.stiffness(m + c, m + c)));
      if (!any_across)
        return {block(slice.stiffness, 0, 0, m, m), block(slice.stiffness, m, m, m, m)};
      slice = join(slice, slice);
    }
    throw ConvergenceError("Waves of the periodic track do not decay within " +
                           std::to_string(most_doublings) +
                           " doublings of its span: give rail or pads a loss factor.");
  }

  ComplexMatrix end_motions(const Slice &slice, const InfiniteEnds &ends)
  {
    const unsigned int m = slice.n_shapes();
    ComplexMatrix S = slice.stiffness, motions = slice.forces;
    if (ends.left.m() > 0)
      add(S, ends.left, 0, 0, 1.);
    if (ends.right.m() > 0)
      add(S, ends.right, m, m, 1.);
    S.compute_lu_factorization();
    S.solve(motions);
    return motions;
  }

  ComplexMatrix receptance(const Slice &slice, const ComplexMatrix &left, const ComplexMatrix &right)
  {
    const ComplexMatrix motions = end_motions(slice, {right, left});
    ComplexMatrix result(slice.n_loads(), slice.n_loads());
    slice.forces.Tmmult(result, motions);
    add(result, slice.compliance, 0, 0, 1.);
    return result;
  }
} // namespace vibrocontact

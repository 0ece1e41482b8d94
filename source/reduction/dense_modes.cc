#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/dense_modes.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Places = std::vector<unsigned int>;

    DenseMatrix part(const DenseMatrix &matrix, const Places &rows, const Places &columns)
    {
      DenseMatrix result(rows.size(), columns.size());
      for (unsigned int j = 0; j < columns.size(); ++j)
        for (unsigned int i = 0; i < rows.size(); ++i)
          result(i, j) = matrix(rows[i], columns[j]);
      return result;
    }

    /// Coordinates that K or M couple, together.
    std::vector<Places> coupled_coordinates(const DenseMatrix &K, const DenseMatrix &M)
    {
      const unsigned int n = K.m();
      std::vector<bool> taken(n, false);
      std::vector<Places> result;
      for (unsigned int first = 0; first < n; ++first)
      {
        if (taken[first])
          continue;
        Places block = {first};
        taken[first] = true;
        for (unsigned int k = 0; k < block.size(); ++k)
          for (unsigned int j = 0; j < n; ++j)
            if (!taken[j] && (K(block[k], j) != 0 || M(block[k], j) != 0))
            {
              taken[j] = true;
              block.push_back(j);
            }
        std::sort(block.begin(), block.end());
        result.push_back(block);
      }
      return result;
    }

    /// Adds the modes of a block to the shapes, and columns with them.
    void add_modes(DenseMatrix K, DenseMatrix M, const Places &rows, const std::string &what,
                   DenseModes &modes)
    {
      const unsigned int n = rows.size(), first = modes.squares.size();
      std::vector<DenseVector> vectors(n, DenseVector(n));
      try
      {
        if (n > 0)
          K.compute_generalized_eigenvalues_symmetric(M, vectors);
      }
      catch (const dealii::ExceptionBase &)
      {
        throw ConvergenceError("LAPACK found no modes of " + what + ".");
      }
      for (unsigned int e = 0; e < n; ++e)
      {
        modes.squares.push_back(std::max(0., K.eigenvalue(e).real()));
        for (unsigned int i = 0; i < n; ++i)
          modes.shapes(rows[i], first + e) = vectors[e][i];
      }
    }

    std::string no_static_motion(const std::string &what)
    {
      return "LAPACK found no static motion of " + what + ".";
    }
  } // namespace

  DenseModes dense_modes(const DenseMatrix &stiffness, const DenseMatrix &mass, const std::string &what)
  {
    DenseModes modes;
    modes.shapes.reinit(mass.m(), mass.m());
    for (const Places &block : coupled_coordinates(stiffness, mass))
    {
      Places held, free;
      for (const unsigned int i : block)
      {
        const bool is_free = std::all_of(block.begin(), block.end(),
                                         [&](const unsigned int j) { return stiffness(i, j) == 0; });
        (is_free ? free : held).push_back(i);
      }
      DenseMatrix none(free.size(), free.size());
      const DenseMatrix M_ff = part(mass, free, free), M_fc = part(mass, free, held),
                        following = solved(M_ff, M_fc, no_static_motion(what));
      const unsigned int first = modes.squares.size() + free.size();
      // equal to the last digit, as LAPACK would not have them
      add_modes(none, M_ff, free, what, modes);
      std::fill(modes.squares.begin() + (first - free.size()), modes.squares.end(), 0.);
      DenseMatrix M = part(mass, held, held);
      if (!free.empty() && !held.empty())
      {
        DenseMatrix taken(held.size(), held.size());
        M_fc.Tmmult(taken, following);
        M.add(-1., taken);
      }
      add_modes(part(stiffness, held, held), M, held, what, modes);
      for (unsigned int e = first; e < modes.squares.size(); ++e)
        for (unsigned int i = 0; i < free.size(); ++i)
          for (unsigned int k = 0; k < held.size(); ++k)
            modes.shapes(free[i], e) -= following(i, k) * modes.shapes(held[k], e);
    }
    return modes;
  }

  DenseMatrix fixed_interface_basis(const DenseMatrix &stiffness, const DenseMatrix &mass,
                                    const unsigned int n_interface, const double highest_omega,
                                    const std::string &what)
  {
    Places ends, inner;
    for (unsigned int i = 0; i < mass.m(); ++i)
      (i < n_interface ? ends : inner).push_back(i);
    const DenseMatrix K = part(stiffness, inner, inner),
                      follow = solved(K, part(stiffness, inner, ends), no_static_motion(what));
    const DenseModes modes = dense_modes(K, part(mass, inner, inner), what);
    std::vector<unsigned int> kept;
    for (unsigned int e = 0; e < modes.squares.size(); ++e)
      if (std::sqrt(modes.squares[e]) <= highest_omega)
        kept.push_back(e);
    DenseMatrix T(mass.m(), n_interface + kept.size());
    for (unsigned int b = 0; b < n_interface; ++b)
    {
      T(b, b) = 1;
      for (unsigned int i = 0; i < inner.size(); ++i)
        T(n_interface + i, b) = -follow(i, b);
    }
    for (unsigned int k = 0; k < kept.size(); ++k)
      for (unsigned int i = 0; i < inner.size(); ++i)
        T(n_interface + i, n_interface + k) = modes.shapes(i, kept[k]);
    return T;
  }

  DenseMatrix projected(const DenseMatrix &A, const DenseMatrix &T)
  {
    DenseMatrix result(T.n(), T.n());
    if (T.n() > 0)
      T.Tmmult(result, product(A, T));
    return result;
  }
} // namespace vibrocontact

#include <vibrocontact/waveguide/section_matrices.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  DenseVector SectionShapes::reduced(const Vector<double> &load) const
  {
    DenseVector result(n());
    shapes.Tvmult(result, load);
    return result;
  }

  std::vector<unsigned int> shapes_with_share(const SectionShapes &shapes, const double share)
  {
    std::vector<unsigned int> result;
    for (unsigned int k = 0; k < shapes.shares.size(); ++k)
      if (shapes.shares[k] >= share)
        result.push_back(k);
    return result;
  }

  SectionShapes all_shapes(const SectionElements &elements)
  {
    SectionShapes result;
    result.shapes.reinit(elements.n_dofs(), elements.n_dofs());
    for (unsigned int i = 0; i < elements.n_dofs(); ++i)
    {
      result.shapes(i, i) = 1;
      result.axial.push_back(elements.dof_direction[i] == 0);
    }
    return result;
  }

  DenseMatrix reduced_matrix(const SparseMatrix<double> &matrix, const SectionShapes &shapes)
  {
    const unsigned int n = matrix.m(), m = shapes.n();
    DenseMatrix products(n, m), result(m, m);
    for (unsigned int j = 0; j < m; ++j)
      for (const auto &entry : matrix)
        products(entry.row(), j) += entry.value() * shapes.shapes(entry.column(), j);
    shapes.shapes.Tmmult(result, products);
    return result;
  }

  SectionMatrices reduced_section(const SectionElements &elements, const SectionShapes &shapes)
  {
    SectionMatrices result;
    for (unsigned int j = 0; j < 3; ++j)
    {
      result.stiffness[j] = reduced_matrix(elements.stiffness[j], shapes);
      result.loss_stiffness[j] = reduced_matrix(elements.loss_stiffness[j], shapes);
    }
    result.mass = reduced_matrix(elements.mass, shapes);
    result.axial = shapes.axial;
    return result;
  }

  namespace
  {
    /// B of wave_stiffness()
    double coupling(const SectionMatrices &section, const unsigned int r, const unsigned int c)
    {
      if (section.axial[r] == section.axial[c])
        return 0;
      return (section.axial[r] ? 1 : -1) * (section.stiffness[1](r, c) - section.stiffness[1](c, r));
    }
  } // namespace

  DenseMatrix wave_stiffness(const SectionMatrices &section, const double k)
  {
    const unsigned int m = section.n_shapes();
    DenseMatrix result(m, m);
    for (unsigned int c = 0; c < m; ++c)
      for (unsigned int r = 0; r < m; ++r)
        result(r, c) =
            section.stiffness[0](r, c) + k * coupling(section, r, c) + k * k * section.stiffness[2](r, c);
    return result;
  }

  std::vector<FreeWave> free_waves(const SectionMatrices &section, const double k, const double up_to)
  {
    const unsigned int m = section.n_shapes();
    DenseMatrix K = wave_stiffness(section, k), M = section.mass;
    Vector<double> values;
    std::vector<Vector<double>> vectors;
    const double highest = std::pow(2 * numbers::PI * up_to, 2);
    K.set_property(LAPACKSupport::symmetric);
    M.set_property(LAPACKSupport::symmetric);
    // the lower end lies below the rounding of motions without stiffness
    vectors.resize(m);
    K.compute_generalized_eigenvalues_symmetric(M, -1e-3 * highest, highest, 0., values, vectors);
    std::vector<FreeWave> result;
    for (unsigned int j = 0; j < values.size(); ++j)
    {
      FreeWave wave;
      const double omega = std::sqrt(std::max(0., values(j)));
      wave.frequency = omega / (2 * numbers::PI);
      wave.shape = vectors[j];
      double slope = 0;
      for (unsigned int c = 0; c < m; ++c)
        for (unsigned int r = 0; r < m; ++r)
          slope +=
              vectors[j](r) * (coupling(section, r, c) + 2 * k * section.stiffness[2](r, c)) * vectors[j](c);
      wave.group_velocity = omega > 0 ? slope / (2 * omega) : 0;
      result.push_back(wave);
    }
    return result;
  }
} // namespace vibrocontact

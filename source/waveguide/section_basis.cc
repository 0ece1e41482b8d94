#include <vibrocontact/waveguide/section_basis.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/sparse_direct.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    // wavenumbers of travelling and of decaying motions [rad/m]
    const std::vector<double> travelling = {0, 2, 5, 9, 14, 21, 32, 50, 90, 180},
                              decaying = {5, 12, 25, 45, 90};
    // shares of the highest frequency
    const std::vector<double> shares = {0, 0.4, 0.75, 1};
    // wavenumber of the norm [rad/m]
    const double kappa = 30;

    using Vectors = std::vector<Vector<double>>;

    /// motion -= its part in orthonormal shapes
    void remove(const Vectors &shapes, const SparseMatrix<double> &norm, Vector<double> &motion)
    {
      for (const Vector<double> &shape : shapes)
        motion.add(-norm.matrix_scalar_product(shape, motion), shape);
    }

    /// Sections that keep their form, orthonormal: u_x = 1, y, z, then u_y = 1, u_z = 1 and the rotation about x.
    Vectors rigid_sections(const SectionElements &elements, const SparseMatrix<double> &norm)
    {
      Vectors result;
      for (unsigned int k = 0; k < 6; ++k)
      {
        Vector<double> motion(elements.n_dofs());
        for (unsigned int i = 0; i < elements.n_dofs(); ++i)
        {
          const double y = elements.dof_position[i][0], z = elements.dof_position[i][1];
          const double motions[6][3] = {{1, 0, 0}, {y, 0, 0}, {z, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -z, y}};
          motion(i) = motions[k][elements.dof_direction[i]];
        }
        remove(result, norm, motion);
        motion /= std::sqrt(norm.matrix_norm_square(motion));
        result.push_back(motion);
      }
      return result;
    }

    /// Shapes of a block of dofs that hold all but a small share of the columns C: (N C)(N C)^T x = share^2 N x, N the norm.
    void decompose(const Vectors &columns, const SparseMatrix<double> &norm, const bool axial,
                   const SectionElements &elements, const double tolerance, Vectors &shapes,
                   std::vector<double> &shares_of_shapes)
    {
      std::vector<unsigned int> place(elements.n_dofs(), numbers::invalid_unsigned_int), dofs;
      for (unsigned int i = 0; i < elements.n_dofs(); ++i)
        if ((elements.dof_direction[i] == 0) == axial)
        {
          place[i] = dofs.size();
          dofs.push_back(i);
        }
      const unsigned int n = dofs.size();
      DenseMatrix N(n, n), C(n, columns.size()), NC(n, columns.size()), shares(n, n);
      for (const auto &entry : norm)
        if (place[entry.row()] < n && place[entry.column()] < n)
          N(place[entry.row()], place[entry.column()]) += entry.value();
      for (unsigned int j = 0; j < columns.size(); ++j)
        for (unsigned int i = 0; i < n; ++i)
          C(i, j) = columns[j](dofs[i]);
      N.mmult(NC, C);
      NC.mTmult(shares, NC);
      shares.set_property(LAPACKSupport::symmetric);
      N.set_property(LAPACKSupport::symmetric);
      Vector<double> values;
      Vectors vectors(n);
      shares.compute_generalized_eigenvalues_symmetric(N, tolerance * tolerance, 1e300, 0., values, vectors);
      for (unsigned int k = values.size(); k-- > 0;)
      {
        Vector<double> shape(elements.n_dofs());
        for (unsigned int i = 0; i < n; ++i)
          shape(dofs[i]) = vectors[k](i);
        shapes.push_back(shape);
        shares_of_shapes.push_back(std::sqrt(values(k)));
      }
    }
  } // namespace

  SectionShapes smooth_shapes(const SectionElements &elements, const Vectors &loads,
                              const SparseMatrix<double> &springs, const SmoothShapesSettings &settings)
  {
    const unsigned int n = elements.n_dofs();
    const double highest = 2 * numbers::PI * settings.up_to;
    SparseMatrix<double> K(elements.pattern), norm(elements.pattern);
    norm.copy_from(elements.stiffness[0]);
    norm.add(kappa * kappa, elements.stiffness[2]);
    norm.add(highest * highest, elements.mass);

    const Vectors rigid = rigid_sections(elements, norm);
    Vectors answers;
    const auto answer = [&](const double k, const double square, const bool real_form)
    {
      for (const double share : shares)
        for (const bool supported : {false, true})
        {
          // a free section has no answer at rest to forces that do not vary along the axis
          if ((supported && springs.empty()) || (!supported && k == 0 && share == 0))
            continue;
          elements.motion_stiffness(k, square, real_form, K);
          K.add(-std::pow(share * highest, 2), elements.mass);
          if (supported)
            K.add(1, springs);
          SparseDirectUMFPACK inverse;
          inverse.initialize(K);
          for (const Vector<double> &load : loads)
          {
            Vector<double> motion(n);
            inverse.vmult(motion, load);
            // what is left beside a rigid section, by its own size
            const double size = std::sqrt(norm.matrix_norm_square(motion));
            remove(rigid, norm, motion);
            motion /= std::max(std::sqrt(norm.matrix_norm_square(motion)), 1e-4 * size);
            answers.push_back(motion);
          }
        }
    };
    for (const double k : travelling)
      answer(k, k * k, true);
    for (const double k : decaying)
      answer(k, -k * k, false);

    SectionShapes result;
    result.dofs = elements.mark_of_dofs();
    Vectors shapes;
    for (const bool axial : {true, false})
    {
      shapes.insert(shapes.end(), rigid.begin() + (axial ? 0 : 3), rigid.begin() + (axial ? 3 : 6));
      result.shares.resize(shapes.size(), 1e300);
      decompose(answers, norm, axial, elements, settings.tolerance, shapes, result.shares);
      result.axial.resize(shapes.size(), axial);
    }
    result.shapes.reinit(n, shapes.size());
    for (unsigned int j = 0; j < shapes.size(); ++j)
      for (unsigned int i = 0; i < n; ++i)
        result.shapes(i, j) = shapes[j](i);
    return result;
  }
} // namespace vibrocontact

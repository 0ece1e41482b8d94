#include <vibrocontact/analyses/limit_cycle/balance_preconditioner.h>

#include <complex>

namespace vibrocontact
{
  BalancePreconditioner::BalancePreconditioner(const HarmonicResponse &response,
                                               const std::vector<MeanLaw> &law, const ContactProblem &problem,
                                               const bool sees_speed, const DenseVector &by_frequency,
                                               const DenseVector &along)
      : problem(problem), n_rows(response.n_rows()), n_functions(response.n_functions()), along(along)
  {
    const unsigned int n = law.size(), border = problem.force_given() ? 1 : 0;
    for (unsigned int k = 0; 2 * k < n_functions; ++k)
    {
      const ComplexMatrix y = response.of_order(k),
                          rate = sees_speed ? response.rate_of_rest_of_order(k) : ComplexMatrix(n_rows);
      ComplexMatrix block(n_rows + border);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int row = contact_row(n, c, i);
          for (unsigned int d = 0; d < 3; ++d)
          {
            const unsigned int from = contact_row(n, d, i);
            block(row, from) += law[i].by_force[c][d];
            const double by_y = law[i].by_response[c][d], by_seen = law[i].by_seen_slip[c][d];
            for (unsigned int j = 0; j < n_rows; ++j)
              block(row, j) += (by_y + by_seen) * y(from, j) - by_seen * rate(from, j);
            if (border > 0)
              block(row, n_rows) -= by_y * problem.approach_of(i)[d];
          }
          if (border > 0)
            block(n_rows, row) = problem.share_of(i)[c];
        }
      block.compute_lu_factorization();
      blocks.push_back(block);
    }
    solve_blocks(by_frequency, of_frequency);
  }

  void BalancePreconditioner::vmult(DenseVector &to, const DenseVector &from) const
  {
    solve_blocks(from, to);
    // along . (x - w of_frequency) = last
    const unsigned int last = from.size() - 1;
    const double w = (along * to - from[last]) / (along * of_frequency);
    to.add(-w, of_frequency);
    to[last] = w;
  }

  void BalancePreconditioner::solve_blocks(const DenseVector &from, DenseVector &to) const
  {
    using Complex = std::complex<double>;
    to.reinit(from.size());
    const unsigned int at_approach = n_rows * n_functions;
    for (unsigned int k = 0; k < blocks.size(); ++k)
    {
      const unsigned int real = k == 0 ? 0 : 2 * k - 1, imaginary = k == 0 ? 0 : 2 * k;
      ComplexVector part(blocks[k].m());
      const auto number = [&](const unsigned int re, const unsigned int im)
      { return Complex(from[re], k == 0 ? 0. : from[im]); };
      for (unsigned int i = 0; i < n_rows; ++i)
        part[i] = number(real * n_rows + i, imaginary * n_rows + i);
      if (problem.force_given())
        part[n_rows] = number(at_approach + real, at_approach + imaginary);
      blocks[k].solve(part);
      const auto put = [&](const unsigned int re, const unsigned int im, const Complex value)
      {
        to[re] = value.real();
        if (k > 0)
          to[im] = value.imag();
      };
      for (unsigned int i = 0; i < n_rows; ++i)
        put(real * n_rows + i, imaginary * n_rows + i, part[i]);
      if (problem.force_given())
        put(at_approach + real, at_approach + imaginary, part[n_rows]);
    }
  }
} // namespace vibrocontact

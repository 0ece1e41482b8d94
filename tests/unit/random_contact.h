#pragma once

#include <vibrocontact/contact/contact_problem.h>
#include <vibrocontact/contact/laws/normal_laws.h>

#include <memory>
#include <random>

/// A contact problem with a random positive definite, not symmetric matrix and some points in contact.
inline vibrocontact::ContactProblem random_contact(const unsigned int n, const unsigned int n_components,
                                                   const double mu,
                                                   std::shared_ptr<const vibrocontact::NormalLaw> law,
                                                   const unsigned int seed)
{
  const unsigned int m = n_components * n;
  std::mt19937 random(seed);
  std::normal_distribution<double> number;
  vibrocontact::DenseMatrix root(m, m), A(m, m);
  vibrocontact::ContactProblem problem;
  problem.title = "random";
  problem.b.reinit(m);
  for (unsigned int i = 0; i < m; ++i)
  {
    problem.b[i] = (i < n ? 1e-4 : 3e-5) * (number(random) - (i < n ? 0.7 : 0.));
    for (unsigned int j = 0; j < m; ++j)
      root(i, j) = number(random);
  }
  for (unsigned int i = 0; i < m; ++i)
    for (unsigned int j = 0; j < m; ++j)
    {
      for (unsigned int k = 0; k < m; ++k)
        A(i, j) += 1e-8 * root(i, k) * root(j, k);
      A(i, j) += (i == j ? 1e-7 : 2e-9 * number(random));
    }
  problem.A = std::make_shared<vibrocontact::DenseContactOperator>(A, n_components);
  problem.mu.assign(n, mu);
  problem.normal_law = law;
  return problem;
}

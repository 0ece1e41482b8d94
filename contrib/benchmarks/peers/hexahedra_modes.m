% hexahedra_modes.m COUNT: lowest natural frequencies of a steel block of linear hexahedra, held on some nodes.
% Reads in the current folder nodes.csv (x, y, z in m, by number), cells.csv (8 nodes each) and held.csv; writes frequencies.csv (Hz).
count = str2double(argv(){1});
E = 2.1e11; nu = 0.3; rho = 7850;
nodes = csvread("nodes.csv"); cells = csvread("cells.csv"); held = csvread("held.csv");
lambda = E * nu / (1 + nu) / (1 - 2 * nu); mu = E / 2 / (1 + nu);
D = diag([2 * mu * [1 1 1], mu * [1 1 1]]); D(1:3, 1:3) += lambda;
corner = [-1 -1 -1; 1 -1 -1; 1 1 -1; -1 1 -1; -1 -1 1; 1 -1 1; 1 1 1; -1 1 1];
n_cells = rows(cells); rows_K = zeros(576, n_cells); columns_K = rows_K; values_K = rows_K; values_M = rows_K;
for e = 1:n_cells
  x = nodes(cells(e, :), :); Ke = zeros(24); Me = zeros(24);
  for p = 1:8
    xi = corner(p, :) / sqrt(3);
    t = 1 + corner .* xi;
    N = prod(t, 2)' / 8;
    dN = [corner(:, 1) .* t(:, 2) .* t(:, 3), corner(:, 2) .* t(:, 1) .* t(:, 3), corner(:, 3) .* t(:, 1) .* t(:, 2)]' / 8;
    J = dN * x; g = J \ dN; w = det(J);
    B = zeros(6, 24);
    B(1, 1:3:24) = g(1, :); B(2, 2:3:24) = g(2, :); B(3, 3:3:24) = g(3, :);
    B(4, 1:3:24) = g(2, :); B(4, 2:3:24) = g(1, :);
    B(5, 2:3:24) = g(3, :); B(5, 3:3:24) = g(2, :);
    B(6, 1:3:24) = g(3, :); B(6, 3:3:24) = g(1, :);
    Ke += w * B' * D * B; Me += w * rho * kron(N' * N, eye(3));
  end
  dofs = reshape(3 * cells(e, :) - [2; 1; 0], 1, 24);
  [c, r] = meshgrid(dofs, dofs);
  rows_K(:, e) = r(:); columns_K(:, e) = c(:); values_K(:, e) = Ke(:); values_M(:, e) = Me(:);
end
n = 3 * rows(nodes);
K = sparse(rows_K(:), columns_K(:), values_K(:), n, n); M = sparse(rows_K(:), columns_K(:), values_M(:), n, n);
free = setdiff(1:n, [3 * held - 2; 3 * held - 1; 3 * held]);
K = K(free, free); M = M(free, free); K = (K + K') / 2; M = (M + M') / 2;
squares = sort(eigs(K, M, count, 0));
f = fopen("frequencies.csv", "w"); fprintf(f, "%.17g\n", sqrt(squares) / 2 / pi); fclose(f);

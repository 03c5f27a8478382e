# Writes an STL surface: a pipe of radius R along x that turns by a quarter circle of radius B into y,
# with straight legs of length A and C; lengths in m. Solids: inlet, wall, outlet.

function triangle(i, j, k) {
    print "facet normal 0 0 0\n outer loop"
    print "  vertex " X[i], Y[i], Z[i] "\n  vertex " X[j], Y[j], Z[j] "\n  vertex " X[k], Y[k], Z[k]
    print " endloop\nendfacet"
}

# Ring number m with its centre at (x, y), the pipe pointing there along (cos a, sin a)
function ring(m, x, y, a,    k, t) {
    for (k = 0; k < N; k++) {
        t = 2*PI*k/N
        X[m*N + k] = x - R*cos(t)*sin(a)
        Y[m*N + k] = y + R*cos(t)*cos(a)
        Z[m*N + k] = R*sin(t)
    }
}

function disc(name, m, x, y, turned,    k, c) {
    c = (turned ? -1 : -2)
    X[c] = x; Y[c] = y; Z[c] = 0
    print "solid " name
    for (k = 0; k < N; k++)
        if (turned) triangle(c, m*N + (k + 1)%N, m*N + k)
        else triangle(c, m*N + k, m*N + (k + 1)%N)
    print "endsolid " name
}

BEGIN {
    PI = atan2(0, -1)
    R = 0.002; A = 0.010; B = 0.006; C = 0.010
    N = 96; BENDS = 96
    OFMT = CONVFMT = "%.9g"
    ring(0, 0, 0, 0)
    for (m = 0; m <= BENDS; m++)
        ring(m + 1, A + B*sin(PI/2*m/BENDS), B*(1 - cos(PI/2*m/BENDS)), PI/2*m/BENDS)
    last = BENDS + 2
    ring(last, A + B, B + C, PI/2)

    disc("inlet", 0, 0, 0, 1)
    print "solid wall"
    for (m = 0; m < last; m++)
        for (k = 0; k < N; k++) {
            i = m*N + k; j = m*N + (k + 1)%N
            triangle(i, j, j + N)
            triangle(i, j + N, i + N)
        }
    print "endsolid wall"
    disc("outlet", last, A + B, B + C, 0)
}

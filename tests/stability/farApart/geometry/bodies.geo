// Two blocks, two kilometres from each other.
SetFactory("OpenCASCADE");
Rectangle(1) = {2, 0.5, 0, 1, 1};
Rectangle(2) = {2002.25, 0.75, 0, 1.5, 1};
Physical Surface("near") = {1};
Physical Surface("far") = {2};

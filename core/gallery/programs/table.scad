// A side table with a shelf, in millimetres. Front towards -y, standing on z = 0.
module leg() cube([50, 50, 520]);

// board
color("burlywood") translate([-300, -300, 520]) cube([600, 600, 30]);
// shelf
color("burlywood") translate([-250, -250, 160]) cube([500, 500, 30]);
for (x = [-300, 250], y = [-300, 250]) {
  color("sienna") translate([x, y, 0]) leg();
}

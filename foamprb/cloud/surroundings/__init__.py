"""What around a particle changes the fluid that it feels: walls, molecules, turbulence."""

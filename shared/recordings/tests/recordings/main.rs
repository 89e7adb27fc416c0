//! Recordings of people: reaches, arms, ways of carrying.

mod arms;
mod reading;
mod ways;

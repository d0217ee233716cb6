"use strict";
// The papers, by the keys that records have: who wrote them, and what stands in a bibliography.
const PAPERS = {
  creus: {short: "Creus 2010", about: "rain as particles that fall through a city", author: "Creus, Carles", title: "Real-time realistic rain rendering", year: "2010", type: "mastersthesis"},
  stuppacher: {short: "Stuppacher 2007", about: "water drops on panes", author: "Stuppacher, Ines and Supan, Peter", title: "Rendering of Water Drops in Real-Time", year: "2007", type: "inproceedings"},
  chin: {short: "Chin 2016", about: "raindrops that run down a window", author: "Chin, A.", title: "Animating Raindrops on a Surface", year: "2016", type: "misc"},
  feng: {short: "Feng", about: "rain drawn as a cartoon", author: "Feng, Z.-X. and others", title: "Real-time Rain Simulation in Cartoon Style", year: "", type: "inproceedings"},
  ye: {short: "Ye", about: "rain as a particle system", author: "Ye, Li-na", title: "Raining Simulation based on Improved Particle Systems algorithms", year: "", type: "inproceedings"},
};
const SOFTWARE = {author: "{raingauge contributors}", title: "raingauge: the rain of published papers on every graphics API", type: "software"};

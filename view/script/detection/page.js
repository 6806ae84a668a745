// The page of a detection, put together.

function summary(data) {
  const count = (number, one, several) => `${number || "no"} ${number === 1 ? one : several}`;
  const found = `Found: ${count(data.cups.length, "cup", "cups")} and ${count(data.candidates.length, "other thing", "other things")}`;
  if (!data.desk) return [element("p", { class: "answer" }, data.why)];
  return [element("p", { class: "answer" }, `${found} on the desk.`),
          element("p", { class: "small" }, `The sensor is ${oneDecimal(data.desk.height_mm)} mm above it, pitched by ${oneDecimal(data.desk.pitch_deg)}°. ${data.cloud ? `Cloud: ${data.cloud}.` : ""}`)];
}

function build(data, page) {
  const things = thingsOf(data);
  things.forEach((thing, k) => thing.owner = k + 2);
  const parts = layout(page, "a cup"), stage = new FoundStage(data, things, parts.stage);
  const state = { colouring: "class", picked: null };

  let high = 0.05;
  for (const { height } of things) high = Math.max(high, height);
  const heights = { title: "Height above the desk", scale: HEIGHTS, ends: ["0 mm", `${Math.round(high * MM)} mm`] };
  const classes = [CLASSES.other, CLASSES.desk, ...things].map(({ colour }) => new THREE.Color(colour));
  const paint = () => {
    const byClass = state.colouring === "class";
    stage.showPoints(data, byClass ? i => classes[data.owners[i]] : (i, p) => colourOf(HEIGHTS, p.z / high));
    const present = new Set([...data.cups.map(contentOf), ...(data.candidates.length ? [CLASSES.candidate] : []), ...(data.desk ? [CLASSES.desk] : []), CLASSES.other]);
    const level = element("span", { class: "swatch" }, element("i", { class: "dashed" }), "level that is measured inside");
    parts.legend.replaceChildren(...(byClass ? [...present].map(({ colour, words }) => swatch(colour, words)) : legend(heights)),
                                 ...(data.cups.some(({ surface_mm }) => surface_mm !== null) ? [level] : []));
  };

  const cards = new Map();
  const pick = thing => {
    state.picked = thing;
    stage.pick(thing);
    for (const [other, card] of cards) card.setAttribute("aria-pressed", other === thing);
    parts.story.replaceChildren(...storyOf(data, thing));
    document.documentElement.dataset.picked = thing.cup ? `cup ${thing.number}` : `candidate ${thing.number}`;
  };
  stage.onPick = owner => owner >= 2 && pick(things[owner - 2]);
  const card = (thing, name, more) => {
    const made = element("button", { type: "button", class: "card", "aria-pressed": "false", onclick: () => pick(thing) }, swatch(thing.colour, name), element("small", {}, more));
    cards.set(thing, made);
    return made;
  };

  const middle = stage.middle.clone().setZ(data.desk ? 0.03 : stage.middle.z), room = Math.max(stage.reach * 3.2, 0.52);
  const views = {
    "all": () => stage.look(stage.from(0.8, 0.5), middle, room),
    "picked": () => state.picked && stage.look(stage.from(0.75, 0.55), state.picked.at.clone().setZ(0.45 * state.picked.height), 5.2 * Math.max(state.picked.height, 2 * state.picked.radius)),
    "sensor": () => stage.look(stage.camera.clone().sub(middle), middle, stage.camera.distanceTo(middle)),
    "side": () => state.picked && stage.look(stage.from(0.12, 1).addScaledVector(stage.across, 1), state.picked.at.clone().setZ(0.45 * state.picked.height), 4.2 * Math.max(state.picked.height, 2 * state.picked.radius)),
    "above": () => stage.look(stage.from(100, 0), middle, room) };
  parts.buttons.append(button("All", views.all), ...(things.length ? [button("What was picked", views.picked), button("From the side", views.side)] : []),
                       button("From above", views.above), button("From the sensor", views.sensor));

  const cups = things.filter(({ cup }) => cup), others = things.filter(({ candidate }) => candidate);
  parts.panel.append(
    ...summary(data),
    element("div", { class: "cards" }, ...cups.map(thing =>
      card(thing, shortName(thing.cup, thing.number), `rim ${oneDecimal(thing.cup.height_mm)} mm, radius ${oneDecimal(thing.cup.radius_mm)} mm`))),
    ...(others.length ? [element("h2", {}, "What is no cup, and why"), element("div", { class: "cards" }, ...others.map(thing =>
      card(thing, `${oneDecimal(thing.candidate.width_mm)} mm wide, ${oneDecimal(thing.candidate.height_mm)} mm high`, thing.candidate.reason)))] : []),
    choice("Colour of the points", "colouring", { class: "what they belong to", height: "height above the desk" }, state.colouring,
           value => { state.colouring = value; paint(); }),
    element("fieldset", {}, element("legend", {}, "Show"), tick("Models of the cups", true, on => { stage.show(stage.models, on); stage.show(stage.bodies, on); }),
            tick("Outlines of what is no cup", true, on => stage.show(stage.outlines, on)),
            tick("Points", true, on => stage.show(stage.points, on))));
  if (data.every > 1) parts.panel.append(element("p", { class: "small" }, `Of the cloud's points every ${data.every}. is drawn.`));

  // "#view=above&colouring=height&cup=1" or "&candidate=0", each of them if wanted.
  const wish = wishes();
  grantChoices(parts.panel, state, ["colouring"]);
  paint();
  const wanted = cups[Number(wish.get("cup") ?? NaN)] || others[Number(wish.get("candidate") ?? NaN)] || things[0];
  if (wanted) pick(wanted);
  views[granted(wish.get("view"), views, data.desk ? "all" : "sensor")]();
}

start(build);

// The device's image, in which a pixel can be chosen.

class PixelMap {
  constructor(scene, pick) {
    this.scene = scene;
    this.canvas = element("canvas", {
      id: "map", tabindex: "0", role: "img", width: scene.columns, height: scene.rows,
      "aria-label": "The device's image. Click a pixel; arrow keys move the chosen one, with shift by ten." });
    this.canvas.addEventListener("click", event => {
      const box = this.canvas.getBoundingClientRect();
      pick(Math.floor((event.clientX - box.left) / box.width * scene.columns), Math.floor((event.clientY - box.top) / box.height * scene.rows));
    });
    this.canvas.addEventListener("keydown", event => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (!step) return;
      event.preventDefault();
      const by = event.shiftKey ? 10 : 1;
      pick(scene.column(this.pixel) + by * step[0], scene.row(this.pixel) + by * step[1]);
    });
  }

  paint(kind, colouring) {
    const context = this.canvas.getContext("2d"), picture = context.createImageData(this.scene.columns, this.scene.rows);
    for (let i = 0; i < this.scene.count; ++i) {
      const share = this.scene.has(i, kind) ? colouring.share(i, kind) : NaN;
      const c = Number.isNaN(share) ? new THREE.Color("#ffffff") : colourOf(colouring.scale, share);
      picture.data.set([255 * c.r, 255 * c.g, 255 * c.b, 255], 4 * i);
    }
    this.picture = picture;
    if (this.pixel !== undefined) this.mark(this.pixel);
  }

  mark(pixel) {
    this.pixel = pixel;
    const context = this.canvas.getContext("2d"), x = this.scene.column(pixel) + 0.5, y = this.scene.row(pixel) + 0.5;
    context.putImageData(this.picture, 0, 0);
    for (const [colour, width] of [["#ffffff", 5], ["#d00000", 2]]) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        context.moveTo(x + 5 * dx, y + 5 * dy);
        context.lineTo(x + 16 * dx, y + 16 * dy);
      }
      context.stroke();
    }
  }
}
